#include "dynamics/event.h"
#include "fields/image.h"
#include "fields/mesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numeric>
#include <optional>

// Whether a mesh encloses something.

namespace lamella {
namespace {

using Eigen::Vector3d;
using Edge = std::pair<int, int>; // the lower index first

std::string place_of(const Vector3d& p) { return place_text({p[0], p[1], p[2]}); }

std::map<Edge, int> triangles_of_edges(const Mesh& mesh) {
  std::map<Edge, int> count;
  for (const auto& corners : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(corners[i], corners[(i + 1) % 3]);
      ++count[{low, high}];
    }
  return count;
}

/// The number of separate chains that edges form.
int count_chains(const std::vector<Edge>& edges, std::size_t points) {
  std::vector<int> parent(points);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int p) {
    while (parent[p] != p) p = parent[p] = parent[parent[p]];
    return p;
  };
  for (const auto& [a, b] : edges) parent[root(a)] = root(b);
  std::vector<int> roots;
  for (const Edge& edge : edges) roots.push_back(root(edge.first));
  std::ranges::sort(roots);
  return int(std::ranges::unique(roots).begin() - roots.begin());
}

void check_edges(const Mesh& mesh) {
  std::vector<Edge> open, branching;
  for (const auto& [edge, count] : triangles_of_edges(mesh))
    if (count != 2) (count < 2 ? open : branching).push_back(edge);
  const auto where = [&](const Edge& edge) {
    return place_of(0.5 * (mesh.points[edge.first] + mesh.points[edge.second]));
  };
  if (!open.empty()) {
    const int holes = count_chains(open, mesh.points.size());
    throw InputError(fmt::format("the surface is not closed: it has {} hole{}, with {} edges, one "
                                 "of them at {}; vtkFillHolesFilter closes small ones",
                                 holes, holes == 1 ? "" : "s", open.size(), where(open.front())));
  }
  if (!branching.empty())
    throw InputError(fmt::format("the surface branches: {} edges are shared by more than two "
                                 "triangles, one of them at {}",
                                 branching.size(), where(branching.front())));
}

/// Where the segment from p to q passes through a triangle; nothing for one in its plane.
std::optional<Vector3d> crossing(const Vector3d& p, const Vector3d& q,
                                 const std::array<Vector3d, 3>& triangle) {
  const auto& [a, b, c] = triangle;
  const Vector3d along = q - p, u = b - a, v = c - a, normal = u.cross(v);
  const double slope = along.dot(normal);
  if (std::abs(slope) <= 1e-12 * along.norm() * normal.norm()) return {};
  const double t = (a - p).dot(normal) / slope;
  if (t < 0 || t > 1) return {};
  const Vector3d x = p + t * along, w = x - a;
  const double area = normal.squaredNorm(), s = w.cross(v).dot(normal) / area,
               r = u.cross(w).dot(normal) / area;
  if (s < 0 || r < 0 || s + r > 1) return {};
  return x;
}

/// Triangles by the cells of a lattice, about as large as they are, that their bounds touch.
class Buckets {
public:
  explicit Buckets(const Mesh& mesh) : mesh_(mesh) {
    double extent = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto [low, high] = bounds(t);
      extent += (high - low).maxCoeff();
    }
    cell_ = extent / double(mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for_each_cell(t, [&](const std::array<int, 3>& cell) { triangles_[cell].push_back(int(t)); });
  }

  /// f(a, b) for pairs that share a cell, maybe several times.
  template <class F>
  void for_each_pair(F&& f) const {
    for (const auto& [cell, members] : triangles_)
      for (std::size_t i = 0; i < members.size(); ++i)
        for (std::size_t j = i + 1; j < members.size(); ++j) f(members[i], members[j]);
  }

  MeshBounds bounds(std::size_t triangle) const {
    const auto [a, b, c] = mesh_.corners(triangle);
    return {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
  }

private:
  template <class F>
  void for_each_cell(std::size_t triangle, F&& f) const {
    const auto [low, high] = bounds(triangle);
    std::array<int, 3> first, last;
    for (int d = 0; d < 3; ++d) {
      first[d] = int(std::floor(low[d] / cell_));
      last[d] = int(std::floor(high[d] / cell_));
    }
    for (int k = first[2]; k <= last[2]; ++k)
      for (int j = first[1]; j <= last[1]; ++j)
        for (int i = first[0]; i <= last[0]; ++i) f({i, j, k});
  }

  const Mesh& mesh_;
  double cell_;
  std::map<std::array<int, 3>, std::vector<int>> triangles_;
};

/// Where two triangles without a common point cross.
std::optional<Vector3d> crossing(const Mesh& mesh, int one, int other) {
  for (const int p : mesh.triangles[one])
    for (const int q : mesh.triangles[other])
      if (p == q) return {};
  const auto a = mesh.corners(one), b = mesh.corners(other);
  for (int i = 0; i < 3; ++i) {
    if (const auto x = crossing(a[i], a[(i + 1) % 3], b)) return x;
    if (const auto x = crossing(b[i], b[(i + 1) % 3], a)) return x;
  }
  return {};
}

void check_crossings(const Mesh& mesh) {
  const Buckets buckets(mesh);
  std::map<std::pair<int, int>, Vector3d> found;
  buckets.for_each_pair([&](int a, int b) {
    const MeshBounds first = buckets.bounds(a), second = buckets.bounds(b);
    if ((first.low.array() > second.high.array()).any() ||
        (second.low.array() > first.high.array()).any())
      return;
    if (const auto x = crossing(mesh, a, b)) found.try_emplace({a, b}, *x);
  });
  if (!found.empty())
    throw InputError(fmt::format("the surface crosses itself: {} pairs of its triangles do, one of "
                                 "them at {}",
                                 found.size(), place_of(found.begin()->second)));
}

} // namespace

void check_closed(const Mesh& mesh) {
  check_edges(mesh);
  check_crossings(mesh);
}

} // namespace lamella
