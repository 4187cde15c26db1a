#include "fields/mesh_tree.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <ranges>

namespace lamella {
namespace {

using Eigen::Matrix3d;
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

constexpr int most_in_leaf = 4; // triangles

/// Of the points of an array, those that are in another; -1 for the rest.
std::array<int, 3> in_both(const std::array<int, 3>& one, const std::array<int, 3>& other) {
  std::array<int, 3> both{-1, -1, -1};
  for (int n = 0; n < 3; ++n)
    if (std::ranges::count(other, one[n]) > 0) both[n] = one[n];
  return both;
}

bool has_any(const std::array<int, 3>& common, const std::array<int, 3>& corners) {
  return std::ranges::any_of(common,
                             [&](int p) { return p >= 0 && std::ranges::count(corners, p) > 0; });
}

/// Sums over points, for their covariance.
struct Spread {
  double count = 0;
  Vector3d sum = Vector3d::Zero();
  Matrix3d squares = Matrix3d::Zero();

  void add(const Vector3d& x) {
    count += 1;
    sum += x;
    squares += x * x.transpose();
  }
  /// The axes along which they spread, the widest last.
  Matrix3d axes() const {
    Eigen::SelfAdjointEigenSolver<Matrix3d> solver;
    solver.computeDirect(squares - sum * sum.transpose() / count);
    return solver.eigenvectors();
  }
};

} // namespace

double TriangleTree::Box::squared_distance(const Vector3d& x) const {
  return ((axes.transpose() * (x - middle)).cwiseAbs() - half).cwiseMax(0).squaredNorm();
}

/// Unless an axis of one of them, or one across two of theirs, separates them.
bool TriangleTree::Box::touches(const Box& other, double within) const {
  const Matrix3d turn = axes.transpose() * other.axes, size = turn.cwiseAbs();
  const Vector3d apart = axes.transpose() * (other.middle - middle);
  const auto separates = [within](double distance, double reach) {
    return std::abs(distance) > reach + within;
  };
  for (int a = 0; a < 3; ++a)
    if (separates(apart[a], half[a] + size.row(a).dot(other.half))) return false;
  for (int b = 0; b < 3; ++b)
    if (separates(apart.dot(turn.col(b)), half.dot(size.col(b)) + other.half[b])) return false;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      const int a1 = (a + 1) % 3, a2 = (a + 2) % 3, b1 = (b + 1) % 3, b2 = (b + 2) % 3;
      if (separates(apart[a2] * turn(a1, b) - apart[a1] * turn(a2, b),
                    half[a1] * size(a2, b) + half[a2] * size(a1, b) + other.half[b1] * size(a, b2) +
                        other.half[b2] * size(a, b1)))
        return false;
    }
  return true;
}

TriangleTree::TriangleTree(const Mesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
  constexpr double rounding = 1e-12; // of the diagonal of the bounds
  std::iota(order_.begin(), order_.end(), 0);
  if (order_.empty()) return;
  const auto [low, high] = bounds_of(mesh);
  rounding_ = rounding * (high - low).norm();
  nodes_.push_back({box_around(order_), {}, 0, int(order_.size())});
  for (int node = 0; node < int(nodes_.size()); ++node) divide(node);
  for (Node& node : nodes_ | std::views::reverse)
    if (node.first >= 0)
      node.common = in_both(nodes_[node.first].common, nodes_[node.first + 1].common);
}

TriangleTree::Box TriangleTree::box_around(std::span<const int> triangles) const {
  const Vector3d& origin = mesh_.points[mesh_.triangles[triangles.front()].front()];
  Spread spread;
  for (const int triangle : triangles)
    for (const int p : mesh_.triangles[triangle]) spread.add(mesh_.points[p] - origin);
  const Matrix3d axes = spread.axes();
  Eigen::AlignedBox3d bounds;
  for (const int triangle : triangles)
    for (const int p : mesh_.triangles[triangle])
      bounds.extend(Vector3d(axes.transpose() * (mesh_.points[p] - origin)));
  return {origin + axes * bounds.center(), (0.5 * bounds.sizes().array() + rounding_).matrix(),
          axes};
}

/// Half of the triangles to each side along the widest axis of its box, until they are few.
void TriangleTree::divide(int number) {
  const int begin = nodes_[number].begin, end = nodes_[number].end;
  if (end - begin <= most_in_leaf) {
    nodes_[number].common = mesh_.triangles[order_[begin]];
    for (int n = begin + 1; n < end; ++n)
      nodes_[number].common = in_both(nodes_[number].common, mesh_.triangles[order_[n]]);
    return;
  }
  const Vector3d along = nodes_[number].box.axes.col(2);
  const auto place = [&](int triangle) {
    const auto [a, b, c] = mesh_.corners(triangle);
    return along.dot(a + b + c);
  };
  const int middle = (begin + end) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](int one, int other) { return place(one) < place(other); });
  nodes_[number].first = int(nodes_.size());
  for (const auto& [from, to] : {std::pair{begin, middle}, {middle, end}})
    nodes_.push_back({box_around(std::span(order_).subspan(from, to - from)), {}, from, to});
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
  // Depth first, the nearer box before the farther: the nearest box of all next, from a heap of
  // them, took three times as long.
  struct Open {
    double distance;
    int node;
  };
  std::array<Open, 64> open{Open{0, 0}}; // the tree is balanced
  for (int count = 1; count > 0;) {
    const Open at = open[--count];
    if (at.distance >= within) continue;
    const Node& node = nodes_[at.node];
    if (node.first < 0) {
      for (int n = node.begin; n < node.end; ++n) ask(order_[n]);
      continue;
    }
    for (const int inner : {node.first, node.first + 1})
      open[count++] = {nodes_[inner].box.squared_distance(x), inner};
    if (open[count - 2].distance < open[count - 1].distance)
      std::swap(open[count - 2], open[count - 1]);
  }
  return found;
}

std::vector<int> TriangleTree::near(int triangle) const {
  const Box own = box_around(std::span(&triangle, 1));
  std::vector<int> found, open{0};
  while (!open.empty()) {
    const Node& node = nodes_[open.back()];
    open.pop_back();
    if (has_any(node.common, mesh_.triangles[triangle]) || !own.touches(node.box, rounding_))
      continue;
    if (node.first >= 0) {
      open.insert(open.end(), {node.first, node.first + 1});
      continue;
    }
    for (int n = node.begin; n < node.end; ++n)
      if (!has_any(mesh_.triangles[order_[n]], mesh_.triangles[triangle]))
        found.push_back(order_[n]);
  }
  return found;
}

LineCrossings::LineCrossings(const Mesh& mesh) : mesh_(mesh) {
  std::vector<int> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<Eigen::AlignedBox2d> boxes;
  for (const int triangle : all) {
    Eigen::AlignedBox2d box;
    for (const Vector3d& corner : mesh.corners(triangle)) box.extend(corner.tail<2>());
    boxes.push_back(box);
  }
  tree_.init(all.begin(), all.end(), boxes.begin(), boxes.end());
}

std::vector<LineCrossings::Crossing> LineCrossings::at(double y, double z) const {
  struct Query {
    const Mesh& mesh;
    double y, z;
    std::vector<Crossing> found;
    bool intersectVolume(const Eigen::AlignedBox2d& box) {
      return box.contains(Eigen::Vector2d(y, z));
    }
    bool intersectObject(int triangle) {
      if (const auto x = crossing(mesh, triangle, y, z)) found.push_back({*x, triangle});
      return false;
    }
  } query{mesh_, y, z, {}};
  Eigen::BVIntersect(tree_, query);
  return query.found;
}

} // namespace lamella
