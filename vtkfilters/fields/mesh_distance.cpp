#include "fields/mesh.h"

#include "parallel.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

// The level set of a closed mesh.

namespace lamella {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double near = 1.5; // spacings from its bounds: where a triangle is asked for at once
// Lines to count crossings on are so far, in spacings, beside the nodes: none of them hits an edge.
constexpr double aside_y = 1.1e-7, aside_z = 1.7e-7;

/// Nearest point to x of a triangle (Ericson, Real-Time Collision Detection, 5.1.5).
Vector3d nearest_point(const Vector3d& x, const std::array<Vector3d, 3>& triangle) {
  const auto& [a, b, c] = triangle;
  const Vector3d ab = b - a, ac = c - a, ax = x - a, bx = x - b, cx = x - c;
  const double d1 = ab.dot(ax), d2 = ac.dot(ax), d3 = ab.dot(bx), d4 = ac.dot(bx), d5 = ab.dot(cx),
               d6 = ac.dot(cx);
  if (d1 <= 0 && d2 <= 0) return a;
  if (d3 >= 0 && d4 <= d3) return b;
  if (d6 >= 0 && d5 <= d6) return c;
  const double of_c = d1 * d4 - d3 * d2, of_b = d5 * d2 - d1 * d6, of_a = d3 * d6 - d5 * d4;
  if (of_c <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  if (of_b <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  if (of_a <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const double whole = of_a + of_b + of_c;
  return a + of_b / whole * ab + of_c / whole * ac;
}

/// The nearest triangle that each node knows of, and its distance.
class NearestTriangles {
public:
  NearestTriangles(const Mesh& mesh, const Grid& grid)
      : mesh_(mesh), grid_(grid), triangle_(grid.size(), -1),
        distance_(grid.size(), std::numeric_limits<double>::infinity()) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) ask_around(int(t));
    for (std::size_t n = 0; n < grid.size(); ++n)
      if (triangle_[n] >= 0) front_.push_back(n);
    while (!front_.empty()) spread();
  }

  const std::vector<double>& distance() const { return distance_; }

private:
  void ask(std::size_t node, int triangle) {
    const Vec3 p = grid_.position(node);
    const Vector3d x(p[0], p[1], p[2]);
    const double distance = (x - nearest_point(x, mesh_.corners(triangle))).norm();
    if (distance >= distance_[node]) return;
    distance_[node] = distance;
    triangle_[node] = triangle;
  }

  /// All nodes near a triangle ask for it.
  void ask_around(int triangle) {
    const auto [a, b, c] = mesh_.corners(triangle);
    const Vector3d low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    std::array<int, 3> first, last;
    for (int d = 0; d < 3; ++d) {
      const auto node = [&](double x) { return (x - grid_.origin(d)) / grid_.spacing; };
      first[d] = std::max(0, int(std::ceil(node(low[d]) - near)));
      last[d] = std::min(grid_.nodes[d] - 1, int(std::floor(node(high[d]) + near)));
    }
    for (int k = first[2]; k <= last[2]; ++k)
      for (int j = first[1]; j <= last[1]; ++j)
        for (int i = first[0]; i <= last[0]; ++i) ask(grid_.index(i, j, k), triangle);
  }

  /// The neighbours of nodes that learned of a nearer triangle ask for it too.
  void spread() {
    std::vector<std::size_t> next;
    for (const std::size_t node : front_)
      for_each_neighbour(grid_, int(node), [&](int neighbour) {
        const double before = distance_[neighbour];
        ask(std::size_t(neighbour), triangle_[node]);
        if (distance_[neighbour] < before) next.push_back(std::size_t(neighbour));
      });
    std::ranges::sort(next);
    const auto repeated = std::ranges::unique(next);
    next.erase(repeated.begin(), repeated.end());
    front_ = std::move(next);
  }

  const Mesh& mesh_;
  const Grid& grid_;
  std::vector<int> triangle_;
  std::vector<double> distance_;
  std::vector<std::size_t> front_;
};

double cross(const Vector2d& a, const Vector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

/// Where lines along x cross the mesh, by line j + ny k.
std::vector<std::vector<double>> crossings(const Mesh& mesh, const Grid& grid) {
  const double h = grid.spacing, y0 = grid.origin(1) + aside_y * h,
               z0 = grid.origin(2) + aside_z * h;
  std::vector<std::vector<double>> lines(std::size_t(grid.ny()) * grid.nz());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto corners = mesh.corners(t);
    const Vector2d a = corners[0].tail<2>(), u = corners[1].tail<2>() - a,
                   v = corners[2].tail<2>() - a;
    const double area = cross(u, v);
    if (area == 0) continue;
    const Vector2d low = a + u.cwiseMin(v).cwiseMin(Vector2d::Zero()),
                   high = a + u.cwiseMax(v).cwiseMax(Vector2d::Zero());
    const int j0 = std::max(0, int(std::ceil((low[0] - y0) / h))),
              j1 = std::min(grid.ny() - 1, int(std::floor((high[0] - y0) / h))),
              k0 = std::max(0, int(std::ceil((low[1] - z0) / h))),
              k1 = std::min(grid.nz() - 1, int(std::floor((high[1] - z0) / h)));
    for (int k = k0; k <= k1; ++k)
      for (int j = j0; j <= j1; ++j) {
        const Vector2d w = Vector2d(y0 + j * h, z0 + k * h) - a;
        const double s = cross(w, v) / area, r = cross(u, w) / area;
        if (s < 0 || r < 0 || s + r > 1) continue;
        const double x = corners[0][0] + s * (corners[1][0] - corners[0][0]) +
                         r * (corners[2][0] - corners[0][0]);
        lines[std::size_t(k) * grid.ny() + j].push_back(x);
      }
  }
  return lines;
}

} // namespace

std::vector<double> signed_distance(const Mesh& mesh, const Grid& grid) {
  std::vector<double> distance = NearestTriangles(mesh, grid).distance();
  const auto lines = crossings(mesh, grid);
  for (std::size_t n = 0; n < grid.size(); ++n) {
    const double x = grid.position(n)[0];
    const auto before =
        std::ranges::count_if(lines[n / grid.nx()], [x](double crossing) { return crossing < x; });
    if (before % 2 == 1) distance[n] = -distance[n];
  }
  return distance;
}

} // namespace lamella
