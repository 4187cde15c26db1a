#include "fields/image.h"
#include "fields/mesh_edges.h"
#include "fields/mesh_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

// The parts of a closed mesh.

namespace lamella {
namespace {

using Eigen::Vector3d;

/// The triangles on the other side of each triangle's edges.
std::vector<std::vector<int>> neighbours(const Mesh& mesh) {
  std::vector<std::vector<int>> out(mesh.triangles.size());
  for_each_edge(edges_of(mesh), [&](std::span<const Edge> sides) {
    for (const Edge& side : sides)
      for (const Edge& other : sides)
        if (other.triangle != side.triangle) out[side.triangle].push_back(other.triangle);
  });
  return out;
}

/// Winds a triangle so that it runs along an edge against its neighbour.
void wind_against(const std::array<int, 3>& neighbour, std::array<int, 3>& triangle) {
  for (int e = 0; e < 3; ++e)
    for (int f = 0; f < 3; ++f)
      if (triangle[e] == neighbour[f] && triangle[(e + 1) % 3] == neighbour[(f + 1) % 3])
        return std::swap(triangle[0], triangle[1]);
}

/// The volume between a point and a triangle, signed by its winding.
double under(const std::array<Vector3d, 3>& corners, const Vector3d& from) {
  const Vector3d a = corners[0] - from, b = corners[1] - from, c = corners[2] - from;
  return a.dot(b.cross(c)) / 6;
}

/// Makes a triangle and those that hang together with it the last part.
void add_part(PartedMesh& out, const std::vector<std::vector<int>>& next_to, int triangle) {
  const int part = int(out.parts.size());
  const Vector3d from = out.mesh.corners(triangle)[0];
  double volume = 0;
  std::vector<int> open{triangle};
  out.part_of[triangle] = part;
  while (!open.empty()) {
    const int at = open.back();
    open.pop_back();
    volume += under(out.mesh.corners(at), from);
    for (const int other : next_to[at]) {
      if (out.part_of[other] >= 0) continue;
      wind_against(out.mesh.triangles[at], out.mesh.triangles[other]);
      out.part_of[other] = part;
      open.push_back(other);
    }
  }
  out.parts.push_back({.volume = std::abs(volume)});
}

/// Throws where a mesh encloses nothing, to rounding.
void check_is_not_flat(const PartedMesh& mesh) {
  constexpr double least = 1e-12; // of the cube around it
  const auto [low, high] = bounds_of(mesh.mesh);
  const double side = (high - low).maxCoeff();
  if (std::ranges::all_of(
          mesh.parts, [&](const Part& part) { return part.volume <= least * side * side * side; }))
    throw InputError("the surface is flat: it encloses nothing");
}

/// Whether an odd number of other parts is around a triangle of a part.
bool is_within_odd(const PartedMesh& mesh, const LineCrossings& lines, int triangle) {
  const auto [a, b, c] = mesh.mesh.corners(triangle);
  const Vector3d x = (a + b + c) / 3;
  int before = 0;
  for (const auto& crossing : lines.at(x[1], x[2]))
    before += crossing.x < x[0] && mesh.part_of[crossing.triangle] != mesh.part_of[triangle];
  return before % 2 == 1;
}

} // namespace

std::vector<Edge> edges_of(const Mesh& mesh) {
  std::vector<Edge> edges;
  for (int t = 0; t < int(mesh.triangles.size()); ++t)
    for (int e = 0; e < 3; ++e) {
      const auto [low, high] = std::minmax(mesh.triangles[t][e], mesh.triangles[t][(e + 1) % 3]);
      edges.push_back({low, high, t});
    }
  std::ranges::sort(edges, {}, [](const Edge& e) { return std::tuple(e.low, e.high, e.triangle); });
  return edges;
}

PartedMesh parted(Mesh mesh) {
  const std::size_t triangles = mesh.triangles.size();
  const auto next_to = neighbours(mesh);
  PartedMesh out{std::move(mesh), std::vector<int>(triangles, -1), {}};
  std::vector<int> first; // triangle of each part
  for (int t = 0; t < int(triangles); ++t)
    if (out.part_of[t] < 0) {
      first.push_back(t);
      add_part(out, next_to, t);
    }
  check_is_not_flat(out);
  if (first.size() == 1) return out;
  const LineCrossings lines(out.mesh);
  for (std::size_t p = 0; p < first.size(); ++p)
    out.parts[p].is_hollow = is_within_odd(out, lines, first[p]);
  return out;
}

void drop_small_parts(PartedMesh& mesh, double least_volume, std::string& remark) {
  std::vector<int> number(mesh.parts.size(), -1); // among those that stay
  std::vector<Part> kept;
  double dropped = 0;
  for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
    const bool stays = mesh.parts[p].volume >= least_volume;
    if (stays) {
      number[p] = int(kept.size());
      kept.push_back(mesh.parts[p]);
    } else {
      dropped = std::max(dropped, mesh.parts[p].volume);
    }
  }
  const std::size_t lost = mesh.parts.size() - kept.size();
  if (lost == 0) return;
  std::size_t to = 0;
  for (std::size_t t = 0; t < mesh.part_of.size(); ++t) {
    if (number[mesh.part_of[t]] < 0) continue;
    mesh.mesh.triangles[to] = mesh.mesh.triangles[t];
    mesh.part_of[to++] = number[mesh.part_of[t]];
  }
  mesh.mesh.triangles.resize(to);
  mesh.part_of.resize(to);
  mesh.parts = std::move(kept);
  add_remark(remark, fmt::format("{} of the surface's {} parts {} too small for the grid and left "
                                 "out: the largest of them is a ball of radius {:.3g}, and one of "
                                 "{:.3g} is the least",
                                 lost, number.size(), lost == 1 ? "is" : "are", radius_of(dropped),
                                 radius_of(least_volume)));
}

} // namespace lamella
