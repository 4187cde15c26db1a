#include "levelset/critical_points.h"

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
constexpr double same = 0.5;              // spacings between points that are one
constexpr int iterations = 8;

struct Taylor {
  double value;
  Eigen::Vector3d gradient;
  Eigen::Matrix3d hessian;
};

Taylor taylor_at(const LevelSet& phi, const Eigen::Vector3d& x) {
  double o[10];
  kernels().taylor(phi.view(), 1, {&x[0], &x[1], &x[2]}, o);
  Taylor t{o[0], {o[1], o[2], o[3]}, {}};
  t.hessian << o[4], o[7], o[8], o[7], o[5], o[9], o[8], o[9], o[6];
  return t;
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

/// Newton's method for grad phi = 0; false if there is no such point near the start.
bool find_near(const LevelSet& phi, const Eigen::Vector3d& start, Eigen::Vector3d& x, Taylor& t) {
  const double h = phi.grid().spacing;
  x = start;
  for (int i = 0; i < iterations; i++) {
    t = taylor_at(phi, x);
    Eigen::Vector3d step = -t.hessian.inverse() * t.gradient;
    if (!step.allFinite()) return false;
    const double length = step.norm();
    if (length > longest_step * h) step *= longest_step * h / length;
    x += step;
    if ((x - start).norm() > search_radius * h) return false;
    if (length < 1e-3 * h) {
      t = taylor_at(phi, x);
      return true;
    }
  }
  return false;
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
  for (const int node : candidates(phi, band, grad, reach, inside)) {
    const Vec3 start = phi.grid().position(node);
    Eigen::Vector3d x;
    Taylor t;
    if (!find_near(phi, {start[0], start[1], start[2]}, x, t) || (t.value < 0) != inside) continue;
    const auto near = [&](const CriticalPoint& q) {
      return (Eigen::Vector3d(q.place[0], q.place[1], q.place[2]) - x).norm() < same * h;
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
