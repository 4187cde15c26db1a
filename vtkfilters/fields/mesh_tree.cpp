#include "fields/mesh_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace lamella {
namespace {

using Eigen::Vector3d;

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

/// Where the edge between two points passes z; the same to the last bit for both triangles at it.
std::optional<Vector3d> at_height(const Vector3d& low, const Vector3d& high, double z) {
  if ((low[2] > z) == (high[2] > z)) return {};
  return low + (z - low[2]) / (high[2] - low[2]) * (high - low);
}

/// Where a line along x passes through a triangle. An edge counts to one side of the line or the
/// other, for both of its triangles: so a line that enters a closed mesh leaves it.
std::optional<double> crossing(const Mesh& mesh, int triangle, double y, double z) {
  std::array<Vector3d, 2> ends; // of the cut at that height
  int count = 0;
  for (int e = 0; e < 3; ++e) {
    const auto& corners = mesh.triangles[triangle];
    const auto [low, high] = std::minmax(corners[e], corners[(e + 1) % 3]);
    if (const auto p = at_height(mesh.points[low], mesh.points[high], z); p && count < 2)
      ends[count++] = *p;
  }
  if (count < 2 || (ends[0][1] > y) == (ends[1][1] > y)) return {};
  const double t = (y - ends[0][1]) / (ends[1][1] - ends[0][1]);
  return ends[0][0] + t * (ends[1][0] - ends[0][0]);
}

} // namespace

TriangleTree::TriangleTree(const Mesh& mesh) : mesh_(mesh) {
  std::vector<int> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<Box> boxes;
  for (const int triangle : all) boxes.push_back(box_of(triangle));
  tree_.init(all.begin(), all.end(), boxes.begin(), boxes.end());
}

TriangleTree::Box TriangleTree::box_of(int triangle) const {
  const auto [a, b, c] = mesh_.corners(triangle);
  return Box(a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c));
}

template <class Wanted, class F>
void TriangleTree::for_each(Wanted&& wanted, F&& f) const {
  struct Query {
    Wanted& wanted;
    F& f;
    bool intersectVolume(const Box& box) { return wanted(box); }
    bool intersectObject(int triangle) { return f(triangle), false; }
  } query{wanted, f};
  Eigen::BVIntersect(tree_, query);
}

TriangleTree::Nearest TriangleTree::nearest(const Vector3d& x, int guess, double exact) const {
  constexpr double allowed = 0.05; // of what lies beyond `exact`
  Nearest found{std::numeric_limits<double>::infinity(), guess};
  double within = found.distance; // squared: where to look
  const auto ask = [&](int triangle) {
    const double distance = (x - nearest_point(x, mesh_.corners(triangle))).norm();
    if (!(distance < found.distance)) return;
    found = {distance, triangle};
    const double limit = distance - allowed * std::max(0.0, distance - exact);
    within = limit * limit;
  };
  ask(guess);
  // Depth first, the nearer box before the farther: Eigen::BVMinimize, which takes the nearest box
  // of all, keeps a heap of them, and took three times as long.
  struct Open {
    double distance;
    int box;
  };
  std::array<Open, 64> open{Open{0, tree_.getRootIndex()}}; // the tree is balanced
  for (int count = 1; count > 0;) {
    const Open at = open[--count];
    if (at.distance >= within) continue;
    const int *box = nullptr, *end = nullptr, *triangle = nullptr, *last = nullptr;
    tree_.getChildren(at.box, box, end, triangle, last);
    for (; triangle != last; ++triangle) ask(*triangle);
    const int first = count;
    for (; box != end; ++box)
      open[count++] = {tree_.getVolume(*box).squaredExteriorDistance(x), *box};
    if (count == first + 2 && open[first].distance < open[first + 1].distance)
      std::swap(open[first], open[first + 1]);
  }
  return found;
}

std::vector<TriangleTree::Crossing> TriangleTree::crossings(double y, double z) const {
  std::vector<Crossing> found;
  for_each(
      [&](const Box& box) {
        return box.min()[1] <= y && y <= box.max()[1] && box.min()[2] <= z && z <= box.max()[2];
      },
      [&](int triangle) {
        if (const auto x = crossing(mesh_, triangle, y, z)) found.push_back({*x, triangle});
      });
  return found;
}

std::vector<int> TriangleTree::near(int triangle) const {
  const Box around = box_of(triangle);
  std::vector<int> found;
  for_each([&](const Box& box) { return around.intersects(box); },
           [&](int other) {
             if (around.intersects(box_of(other))) found.push_back(other);
           });
  return found;
}

} // namespace lamella
