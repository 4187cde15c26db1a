#include "fields/mesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

// The volume that a closed mesh encloses, however its triangles are wound.

namespace lamella {
namespace {

using Eigen::Vector3d;

/// Six times the volume under a triangle, signed by its winding.
double under(const std::array<Vector3d, 3>& corners) {
  return corners[0].dot(corners[1].cross(corners[2]));
}

/// Triangles that hang together.
struct Part {
  std::vector<std::array<int, 3>> triangles;
  double volume = 0; ///< of what it encloses
};

/// The triangle on the other side of each edge (first, second corner; second, third; third, first).
std::vector<std::array<int, 3>> neighbours(const Mesh& mesh) {
  std::map<std::pair<int, int>, std::pair<int, int>> first; // triangle and edge, by points
  std::vector<std::array<int, 3>> out(mesh.triangles.size());
  for (int t = 0; t < int(mesh.triangles.size()); ++t)
    for (int e = 0; e < 3; ++e) {
      const auto [low, high] = std::minmax(mesh.triangles[t][e], mesh.triangles[t][(e + 1) % 3]);
      const auto [at, is_new] = first.try_emplace({low, high}, t, e);
      if (is_new) continue;
      const auto [other, its_edge] = at->second;
      out[t][e] = other;
      out[other][its_edge] = t;
    }
  return out;
}

/// Winds a triangle so that it runs along an edge against its neighbour.
void wind_against(const std::array<int, 3>& neighbour, std::array<int, 3>& triangle) {
  for (int e = 0; e < 3; ++e)
    for (int f = 0; f < 3; ++f)
      if (triangle[e] == neighbour[f] && triangle[(e + 1) % 3] == neighbour[(f + 1) % 3])
        return std::swap(triangle[0], triangle[1]);
}

/// The parts of a mesh, whose triangles are wound one way in each.
std::vector<Part> parts_of(Mesh& mesh) {
  const auto next_to = neighbours(mesh);
  std::vector<bool> known(mesh.triangles.size());
  std::vector<Part> parts;
  for (std::size_t t = 0; t < known.size(); ++t) {
    if (known[t]) continue;
    Part& part = parts.emplace_back();
    std::vector<int> open{int(t)};
    known[t] = true;
    while (!open.empty()) {
      const int at = open.back();
      open.pop_back();
      part.triangles.push_back(mesh.triangles[at]);
      part.volume += under(mesh.corners(at)) / 6;
      for (const int other : next_to[at]) {
        if (known[other]) continue;
        wind_against(mesh.triangles[at], mesh.triangles[other]);
        known[other] = true;
        open.push_back(other);
      }
    }
    part.volume = std::abs(part.volume);
  }
  return parts;
}

/// By the solid angle that the part covers as seen from a point, which is 4 pi or 0.
bool encloses(const Mesh& mesh, const Part& part, const Vector3d& x) {
  double angle = 0;
  for (const auto& [i, j, k] : part.triangles) { // Van Oosterom and Strackee
    const Vector3d a = mesh.points[i] - x, b = mesh.points[j] - x, c = mesh.points[k] - x;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += 2 * std::atan2(a.dot(b.cross(c)),
                            la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return std::abs(angle) > 2 * M_PI;
}

} // namespace

double volume_of(Mesh mesh) {
  const std::vector<Part> parts = parts_of(mesh);
  double sum = 0;
  for (const Part& part : parts) {
    const Vector3d x = mesh.points[part.triangles.front()[0]];
    const auto depth = std::ranges::count_if(
        parts, [&](const Part& other) { return &other != &part && encloses(mesh, other, x); });
    sum += depth % 2 == 0 ? part.volume : -part.volume;
  }
  return sum;
}

} // namespace lamella
