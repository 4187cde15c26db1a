#include "levelset/critical_points.h"

#include "levelset/taylor.h"
#include "parallel.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace lamella {

namespace {

constexpr double flat = 0.75; // of the slope on the membrane; less is near a critical point
constexpr double another_direction = 0.3; // cosine
constexpr double search_radius = 1.5;     // spacings from the node where the search begins
constexpr double longest_step = 0.6;      // spacings
constexpr double hopeless_step = 4;       // spacings; there is nothing near
constexpr double same = 0.5;              // spacings between points that are one
constexpr int iterations = 8;

Taylor taylor_at(const LevelSet& phi, const Eigen::Vector3d& x) {
  return taylor(phi, {&x, 1}).front();
}

double slope_at_node(const LevelSet& phi, int node) {
  const Grid& grid = phi.grid();
  const int stride[3] = {1, grid.nx(), grid.nx() * grid.ny()};
  double sum = 0;
  for (int d = 0; d < 3; d++) {
    const double difference = phi.nodal()[node + stride[d]] - phi.nodal()[node - stride[d]];
    sum += difference * difference;
  }
  return std::sqrt(sum) / (2 * grid.spacing);
}

/// The nearest point of a neighbour lies in quite another direction: the nodes are on either side
/// of the middle of something thin.
bool is_in_the_middle(const NarrowBand& band, std::size_t s) {
  const Grid& grid = band.grid();
  const ConstPoints x = band.positions(), p = band.points();
  const int stride[3] = {1, grid.nx(), grid.nx() * grid.ny()};
  for (int d = 0; d < 3; d++)
    for (const int side : {-1, 1}) {
      const int t = band.slot(band.node()[s] + side * stride[d]);
      if (t < 0) continue;
      const double product = (x.x[s] - p.x[s]) * (x.x[t] - p.x[t]) +
                             (x.y[s] - p.y[s]) * (x.y[t] - p.y[t]) +
                             (x.z[s] - p.z[s]) * (x.z[t] - p.z[t]);
      const double both = band.distance()[s] * band.distance()[t]; // < 0: on two sides
      if (both > 0 && product < another_direction * both) return true;
    }
  return false;
}

double mean_of_known(std::span<const double> values) {
  double sum = 0;
  int count = 0;
  for (const double v : values) {
    sum += v;
    count += v > 0;
  }
  return count > 0 ? sum / count : 0;
}

/// Nodes from which a critical point may be near.
std::vector<int> candidates(const LevelSet& phi, const NarrowBand& band,
                            std::span<const double> grad, double reach, bool inside) {
  constexpr std::size_t chunk = 4096;
  const double mean = mean_of_known(grad);
  auto find = [&](std::size_t begin, std::size_t end, std::vector<int>& found) {
    for (std::size_t s = begin; s < end; s++) {
      const double slope = grad[s] > 0 ? grad[s] : mean; // there is none for nodes far inside
      const double d = inside ? -band.distance()[s] : band.distance()[s];
      if (d > 0 && d < reach &&
          (slope_at_node(phi, band.node()[s]) < flat * slope || is_in_the_middle(band, s)))
        found.push_back(band.node()[s]);
    }
  };
  return parallel_collect<int>(band.size(), chunk, find);
}

/// Where Newton's method for grad phi = 0 leads from a node.
struct Search {
  int node;
  Eigen::Vector3d start, x;
  Taylor at{0, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};
};

/// The searches that end at a critical point near their node, in order.
void search(const LevelSet& phi, std::vector<Search> open, std::vector<Search>& ended) {
  const double h = phi.grid().spacing;
  for (int i = 0; i < iterations && !open.empty(); i++) {
    std::vector<Eigen::Vector3d> points;
    for (const Search& s : open) points.push_back(s.x);
    const std::vector<Taylor> at = taylor(phi, points);
    std::vector<Search> still_open;
    for (std::size_t k = 0; k < open.size(); k++) {
      Search& s = open[k];
      s.at = at[k];
      Eigen::Vector3d step = -at[k].hessian.inverse() * at[k].gradient;
      const double length = step.norm();
      if (!(length < hopeless_step * h)) continue;
      if (length < 1e-3 * h) {
        ended.push_back(s);
        continue;
      }
      if (length > longest_step * h) step *= longest_step * h / length;
      s.x += step;
      if ((s.x - s.start).norm() < search_radius * h) still_open.push_back(s);
    }
    open = std::move(still_open);
  }
  std::ranges::sort(ended, {}, &Search::node);
}

std::vector<Search> search_from(const LevelSet& phi, std::span<const int> nodes) {
  constexpr std::size_t chunk = 128;
  auto search_chunk = [&](std::size_t begin, std::size_t end, std::vector<Search>& ended) {
    std::vector<Search> open;
    for (std::size_t i = begin; i < end; i++) {
      const Vec3 p = phi.grid().position(nodes[i]);
      open.push_back({nodes[i], {p[0], p[1], p[2]}, {p[0], p[1], p[2]}});
    }
    search(phi, std::move(open), ended);
  };
  return parallel_collect<Search>(nodes.size(), chunk, search_chunk);
}

/// Length of the way from x along a direction to {phi = 0}, by Newton's method from a guess.
double way_to_membrane(const LevelSet& phi, const Eigen::Vector3d& x,
                       const Eigen::Vector3d& direction, double guess) {
  const double h = phi.grid().spacing;
  double way = guess;
  for (int i = 0; i < iterations; i++) {
    const Taylor t = taylor_at(phi, x + way * direction);
    const double step = -t.value / t.gradient.dot(direction);
    if (!(std::abs(step) < h)) return guess;
    way += step;
    if (std::abs(step) < 1e-3 * h) break;
  }
  return way > 0 ? way : guess;
}

/// Band entries of the nodes in a cube around a point, from which the membrane at a distance is
/// seen.
std::vector<int> entries_around(const NarrowBand& band, const Eigen::Vector3d& x, double distance) {
  const Grid& grid = band.grid();
  const int reach = std::max(2, int(std::ceil(distance / grid.spacing)));
  int base[3];
  for (int d = 0; d < 3; d++)
    base[d] = int(std::floor((x[d] - grid.origin(d)) / grid.spacing)) - reach + 1;
  std::vector<int> entries;
  for (int k = base[2]; k < base[2] + 2 * reach; k++)
    for (int j = base[1]; j < base[1] + 2 * reach; j++)
      for (int i = base[0]; i < base[0] + 2 * reach; i++) {
        if (std::min({i, j, k}) < 0 || i >= grid.nx() || j >= grid.ny() || k >= grid.nz()) continue;
        const int s = band.slot(grid.index(i, j, k));
        if (s >= 0) entries.push_back(s);
      }
  return entries;
}

} // namespace

std::vector<CriticalPoint> critical_points(const LevelSet& phi, const NarrowBand& band,
                                           std::span<const double> grad, double reach,
                                           bool inside) {
  const double h = phi.grid().spacing;
  std::vector<CriticalPoint> points;
  for (const auto& [node, start, x, t] :
       search_from(phi, candidates(phi, band, grad, reach, inside))) {
    if ((t.value < 0) != inside) continue;
    const auto near = [h, &at = x](const CriticalPoint& q) {
      return (Eigen::Vector3d(q.place[0], q.place[1], q.place[2]) - at).norm() < same * h;
    };
    if (std::ranges::any_of(points, near)) continue;
    CriticalPoint q{{x[0], x[1], x[2]}, t.value, {}, {}, 1e300, {}};
    q.around = entries_around(band, x, std::abs(band.distance()[band.slot(node)]));
    for (const int s : q.around) {
      const ConstPoints p = band.points();
      q.radius = std::min(q.radius, (Eigen::Vector3d(p.x[s], p.y[s], p.z[s]) - x).norm());
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(t.hessian);
    for (int d = 0; d < 3; d++) {
      q.stiffness[d] = inside ? eigen.eigenvalues()[d] : -eigen.eigenvalues()[2 - d];
      q.across[d] = eigen.eigenvectors()(d, inside ? 2 : 0);
    }
    // The nodes' nearest points lie beside that of x.
    const Eigen::Vector3d across = eigen.eigenvectors().col(inside ? 2 : 0);
    q.radius = std::min({q.radius, way_to_membrane(phi, x, across, q.radius),
                         way_to_membrane(phi, x, -across, q.radius)});
    if (q.radius < reach) points.push_back(std::move(q));
  }
  std::ranges::sort(points, {}, &CriticalPoint::radius);
  return points;
}

} // namespace lamella
