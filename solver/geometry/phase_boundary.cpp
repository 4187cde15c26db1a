#include "geometry/phase_boundary.h"

#include "parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace lamella {

namespace {

using Eigen::Vector3d;
using Curve = std::vector<BoundaryPoint>;

// Lengths in grid spacings.
constexpr double point_distance = 0.5, shortest_step = 1e-3;
constexpr std::size_t least_points = 24; // of a curve, however small
constexpr double turn = 0.3;             // angle that a step may take
constexpr double longest_newton_step = 0.5, converged = 1e-9;
constexpr double trusted = 0.1;      // correction of a predicted point, in steps
constexpr double seed_reach = 1.5;   // a seed further from its cell's middle belongs to other cells
constexpr double same_point = 0.3;   // a seed so near a curve's point, with its direction, is on it
constexpr double transversal = 0.05; // sine of the angle between the gradients
constexpr int seed_iterations = 8, iterations = 4;

/// The quintic between two points of a curve that has their tangents and curvatures; u in [0, 1] is
/// nearly its arc length over `length`. The error of the length is of the seventh order or higher.
struct Arc {
  const BoundaryPoint &a, &b;
  double length;

  Arc(const BoundaryPoint& from, const BoundaryPoint& to)
      : a(from), b(to), length((to.x - from.x).norm()) {
    constexpr double node = 0.7745966692414834; // Gauss rule of three points
    for (int round = 0; round < 4; round++)
      length = (5 * velocity(0.5 - 0.5 * node).norm() + 8 * velocity(0.5).norm() +
                5 * velocity(0.5 + 0.5 * node).norm()) /
               18;
  }

  Vector3d position(double u) const {
    const double u2 = u * u, u3 = u2 * u, v = 1 - u, v3 = v * v * v;
    return a.x + u3 * (10 - 15 * u + 6 * u2) * (b.x - a.x) +
           length * (u * v3 * (1 + 3 * u) * a.t - u3 * v * (4 - 3 * u) * b.t) +
           0.5 * length * length * (u2 * v3 * a.curvature() + u3 * v * v * b.curvature());
  }
  Vector3d velocity(double u) const {
    const double u2 = u * u, v = 1 - u, v2 = v * v;
    return 30 * u2 * v2 * (b.x - a.x) +
           length * (v2 * (1 + 2 * u - 15 * u2) * a.t - u2 * (12 - 28 * u + 15 * u2) * b.t) +
           0.5 * length * length *
               (u * v2 * (2 - 5 * u) * a.curvature() + u2 * v * (3 - 5 * u) * b.curvature());
  }
};

class Tracer {
public:
  Tracer(const LevelSet& phi, const LevelSet& psi) : phi_(phi), psi_(psi), h_(phi.grid().spacing) {}

  Curve seeds(const NarrowBand& band) const;
  /// Points along the curve through `start`, a step or less apart.
  struct Walk {
    Curve points;
    bool closed; ///< otherwise the curve could not be followed beyond the last point
  };
  Walk walk(const BoundaryPoint& start, std::size_t most_points) const;
  /// The closed curve with equally spaced points; none where Newton's method fails.
  std::optional<Curve> finish(Curve walked) const;

private:
  struct Foot {
    BoundaryPoint point;
    Vector3d step; ///< Newton step from it to Gamma
    bool regular;
  };
  std::vector<Foot> feet(std::span<const Vector3d> points) const;
  Curve on_boundary(std::vector<Vector3d> points, int iterations) const;
  std::optional<BoundaryPoint> advance(const BoundaryPoint& from, double& step) const;
  std::vector<Vector3d> equally_spaced(const Curve& curve) const;

  const LevelSet &phi_, &psi_;
  double h_;
};

std::vector<Tracer::Foot> Tracer::feet(std::span<const Vector3d> points) const {
  const std::vector<Taylor> phi = taylor(phi_, points), psi = taylor(psi_, points);
  std::vector<Foot> out(points.size());
  for (std::size_t i = 0; i < points.size(); i++) {
    const CurveGeometry c = curve_geometry(phi[i], psi[i]);
    out[i] = {{c, points[i], 0, 0}, step_to_boundary(phi[i], psi[i], c), false};
    out[i].regular = c.curvature().allFinite() && out[i].step.allFinite() &&
                     psi[i].gradient.dot(c.n) > transversal * psi[i].gradient.norm();
  }
  return out;
}

/// Newton's method from each point; those that do not arrive are left out.
Curve Tracer::on_boundary(std::vector<Vector3d> points, int iterations) const {
  Curve found;
  for (int it = 0;; it++) {
    const std::vector<Foot> at = feet(points);
    auto arrived = [&](const Foot& f) { return f.regular && f.step.norm() < converged * h_; };
    if (it == iterations || std::ranges::all_of(at, arrived)) {
      for (const Foot& f : at)
        if (arrived(f)) found.push_back(f.point);
      return found;
    }
    for (std::size_t i = 0; i < points.size(); i++) {
      const double length = at[i].step.norm(), longest = longest_newton_step * h_;
      if (at[i].regular) points[i] += std::min(1.0, longest / length) * at[i].step;
    }
  }
}

/// Points of Gamma, one or more in every cell of the grid in which both phi and psi change sign.
Curve Tracer::seeds(const NarrowBand& band) const {
  const Grid& grid = band.grid();
  auto changes_sign = [&](const LevelSet& f, std::size_t node) {
    bool sign[2] = {false, false};
    for (int corner = 0; corner < 8; corner++)
      sign[f.nodal()[node + grid.index(corner & 1, corner >> 1 & 1, corner >> 2)] < 0] = true;
    return sign[0] && sign[1];
  };
  auto find = [&](std::size_t begin, std::size_t end, std::vector<Vector3d>& found) {
    for (std::size_t s = begin; s < end; s++) {
      const int node = band.node()[s], i = node % grid.nx(), j = node / grid.nx() % grid.ny(),
                k = node / grid.nx() / grid.ny();
      if (i + 1 == grid.nx() || j + 1 == grid.ny() || k + 1 == grid.nz()) continue;
      if (!changes_sign(phi_, node) || !changes_sign(psi_, node)) continue;
      const Vec3 x = grid.position(node);
      found.push_back(Vector3d(x[0], x[1], x[2]).array() + 0.5 * h_);
    }
  };
  return on_boundary(parallel_collect<Vector3d>(band.size(), 4096, find), seed_iterations);
}

/// The next point along t, `step` or less away: predicted with the curvature, corrected by Newton's
/// method.
std::optional<BoundaryPoint> Tracer::advance(const BoundaryPoint& from, double& step) const {
  for (; step > shortest_step * h_; step /= 2) {
    const Vector3d predicted = from.x + step * from.t + 0.5 * step * step * from.curvature();
    Foot f = feet(std::span(&predicted, 1))[0];
    if (!f.regular || f.step.norm() > trusted * step || f.point.t.dot(from.t) < std::cos(2 * turn))
      continue;
    f.point.x += f.step;
    return f.point;
  }
  return {};
}

Tracer::Walk Tracer::walk(const BoundaryPoint& start, std::size_t most_points) const {
  Curve curve{start};
  double step = point_distance * h_;
  while (curve.size() < most_points) {
    const BoundaryPoint at = curve.back();
    step = std::min({2 * step, point_distance * h_, turn / at.curvature().norm()});
    const Vector3d home = start.x - at.x;
    const double along = home.dot(at.t);
    if (curve.size() > 2 && along > 0 && home.norm() < 1.2 * step && at.t.dot(start.t) > 0)
      return {std::move(curve), true};
    const std::optional<BoundaryPoint> next = advance(at, step);
    if (!next) break;
    curve.push_back(*next);
  }
  return {std::move(curve), false};
}

std::vector<Vector3d> Tracer::equally_spaced(const Curve& curve) const {
  std::vector<Arc> arcs;
  double length = 0;
  for (std::size_t i = 0; i < curve.size(); i++) {
    arcs.emplace_back(curve[i], curve[(i + 1) % curve.size()]);
    length += arcs.back().length;
  }
  const std::size_t n =
      std::max(least_points, std::size_t(std::ceil(length / (point_distance * h_))));
  std::vector<Vector3d> points;
  double passed = 0;
  for (std::size_t i = 0, arc = 0; i < n; i++) {
    const double s = double(i) / double(n) * length;
    while (arc + 1 < arcs.size() && passed + arcs[arc].length <= s) passed += arcs[arc++].length;
    points.push_back(arcs[arc].position((s - passed) / arcs[arc].length));
  }
  return points;
}

/// Of the rounds, the first leaves the points' distances unequal by what the walk's own points were
/// off, the second by less than a part in a million.
std::optional<Curve> Tracer::finish(Curve curve) const {
  for (int round = 0; round < 2; round++) {
    std::vector<Vector3d> points = equally_spaced(curve);
    const std::size_t n = points.size();
    curve = on_boundary(std::move(points), iterations);
    if (curve.size() < n) return {};
  }
  double s = 0;
  for (std::size_t i = 0; i < curve.size(); i++) {
    BoundaryPoint &a = curve[i], &b = curve[(i + 1) % curve.size()];
    const double length = Arc(a, b).length;
    a.s = s;
    s += length;
    a.weight += 0.5 * length;
    b.weight += 0.5 * length;
  }
  return curve;
}

/// Takes those seeds out that lie on a curve. Seeds are sorted by x.
void remove_seeds(Curve& seeds, const Curve& curve, double h) {
  const double reach = same_point * h;
  std::vector<char> gone(seeds.size(), 0);
  for (const BoundaryPoint& p : curve) {
    auto left = [](const BoundaryPoint& q) { return q.x[0]; };
    for (auto q = std::ranges::lower_bound(seeds, p.x[0] - reach, {}, left);
         q != seeds.end() && q->x[0] <= p.x[0] + reach; ++q)
      if ((q->x - p.x).norm() < reach && q->t.dot(p.t) > 0) gone[q - seeds.begin()] = 1;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < seeds.size(); i++)
    if (!gone[i]) seeds[kept++] = seeds[i];
  seeds.resize(kept);
}

} // namespace

void PhaseBoundary::trace(const LevelSet& phi, const LevelSet& psi, const NarrowBand& band) {
  const double h = band.grid().spacing;
  const Tracer tracer(phi, psi);
  points_.clear();
  begin_ = {0};
  unresolved_.clear();
  Curve seeds = tracer.seeds(band);
  const std::size_t most_points = 1000 + 16 * seeds.size();
  std::ranges::sort(seeds, {}, [](const BoundaryPoint& p) { return p.x[0]; });
  while (!seeds.empty()) {
    const Tracer::Walk walk = tracer.walk(seeds.back(), most_points);
    const std::optional<Curve> curve = walk.closed ? tracer.finish(walk.points) : std::nullopt;
    if (curve) {
      points_.insert(points_.end(), curve->begin(), curve->end());
      begin_.push_back(points_.size());
    } else
      unresolved_.push_back(walk.points.back().x);
    seeds.pop_back();
    remove_seeds(seeds, curve ? *curve : walk.points, h);
  }
}

} // namespace lamella
