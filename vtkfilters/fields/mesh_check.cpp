#include "dynamics/event.h"
#include "fields/image.h"
#include "fields/mesh_tree.h"
#include "parallel.h"

#include <Eigen/Geometry>

#include <cmath>
#include <fmt/format.h>
#include <optional>

// Whether a mesh crosses itself.

namespace lamella {
namespace {

using Eigen::Vector3d;

/// Where the segment from p to q passes through a triangle; nothing for one in its plane.
std::optional<Vector3d> crossing(const Vector3d& p, const Vector3d& q,
                                 const std::array<Vector3d, 3>& triangle) {
  const auto& [a, b, c] = triangle;
  const Vector3d along = q - p, u = b - a, v = c - a, normal = u.cross(v);
  const double slope = along.dot(normal);
  if (!(std::abs(slope) > 1e-12 * along.norm() * normal.norm())) return {};
  const double t = (a - p).dot(normal) / slope;
  if (t < 0 || t > 1) return {};
  const Vector3d x = p + t * along, w = x - a;
  const double area = normal.squaredNorm(), s = w.cross(v).dot(normal) / area,
               r = u.cross(w).dot(normal) / area;
  if (s < 0 || r < 0 || s + r > 1) return {};
  return x;
}

/// Where two triangles without a common point cross.
std::optional<Vector3d> crossing(const Mesh& mesh, int one, int other) {
  const auto a = mesh.corners(one), b = mesh.corners(other);
  for (int i = 0; i < 3; ++i) {
    if (const auto x = crossing(a[i], a[(i + 1) % 3], b)) return x;
    if (const auto x = crossing(b[i], b[(i + 1) % 3], a)) return x;
  }
  return {};
}

} // namespace

void check_crossings(const Mesh& mesh) {
  const TriangleTree tree(mesh);
  const auto found = parallel_collect<Vector3d>(
      mesh.triangles.size(), 256,
      [&](std::size_t begin, std::size_t end, std::vector<Vector3d>& places) {
        for (int one = int(begin); one < int(end); ++one)
          for (const int other : tree.near(one))
            if (other > one)
              if (const auto x = crossing(mesh, one, other)) places.push_back(*x);
      });
  if (found.empty()) return;
  const Vector3d& x = found.front();
  throw InputError(fmt::format("the surface crosses itself, or touches itself: {} pair{} of its "
                               "triangles {}, one of them at {}; parts that overlap are joined by "
                               "vtkBooleanOperationPolyDataFilter",
                               found.size(), found.size() == 1 ? "" : "s",
                               found.size() == 1 ? "does" : "do", place_text({x[0], x[1], x[2]})));
}

} // namespace lamella
