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
constexpr double sharpest_arc = 1;       // angle; curvatures of more are limited to it
constexpr double longest_newton_step = 1;
constexpr double trusted = 0.1;      // correction of a predicted point, in steps
constexpr double psi_margin = 0.5;   // beyond its values in a cell, of their range
constexpr double same_place = 1;     // of two ends
constexpr double same_point = 0.3;   // from a curve's point, in its direction: on the curve
constexpr double same_end = 0.1;     // or a step: the curve has come to its end
constexpr double transversal = 0.05; // sine of the angle between the gradients

/// The quintic between two points of a curve that has their tangents and curvatures; u in [0, 1] is
/// nearly its arc length over `length`. The error of the length is of the seventh order or higher.
struct Arc {
  Vector3d start, chord, t0, t1, k0, k1; ///< tangents and curvatures at the ends
  double length;

  Arc(const BoundaryPoint& a, const BoundaryPoint& b)
      : start(a.x), chord(b.x - a.x), t0(a.t), t1(b.t), k0(a.curvature()), k1(b.curvature()),
        length(chord.norm()) {
    for (Vector3d* k : {&k0, &k1}) *k *= std::min(1.0, sharpest_arc / (k->norm() * length));
    constexpr double node = 0.7745966692414834; // Gauss rule of three points
    for (int round = 0; round < 4; round++)
      length = (5 * velocity(0.5 - 0.5 * node).norm() + 8 * velocity(0.5).norm() +
                5 * velocity(0.5 + 0.5 * node).norm()) /
               18;
  }

  Vector3d position(double u) const {
    const double u2 = u * u, u3 = u2 * u, v = 1 - u, v2 = v * v, v3 = v2 * v;
    return start + u3 * (10 - 15 * u + 6 * u2) * chord +
           length * (u * v3 * (1 + 3 * u) * t0 - u3 * v * (4 - 3 * u) * t1) +
           0.5 * length * length * (u2 * v3 * k0 + u3 * v2 * k1);
  }
  Vector3d velocity(double u) const {
    const double u2 = u * u, v = 1 - u, v2 = v * v;
    return 30 * u2 * v2 * chord +
           length * (v2 * (1 + 2 * u - 15 * u2) * t0 - u2 * (12 - 28 * u + 15 * u2) * t1) +
           0.5 * length * length * (u * v2 * (2 - 5 * u) * k0 + u2 * v * (3 - 5 * u) * k1);
  }
};

class Tracer {
public:
  Tracer(const LevelSet& phi, const LevelSet& psi) : phi_(phi), psi_(psi), h_(phi.grid().spacing) {}

  Curve seeds(const NarrowBand& band) const;
  /// Points along the curve through `start`, a step or less apart.
  struct Walk {
    Curve points;
    bool closed; ///< otherwise the curve could not be followed beyond the first and last point
  };
  Walk walk(const BoundaryPoint& start, std::size_t most_points) const;
  /// The closed curve with equally spaced points; none where Newton's method fails.
  std::optional<Curve> finish(const Curve& walked) const;

private:
  struct Foot {
    BoundaryPoint point;
    Vector3d step; ///< Newton step from it to Gamma
    bool regular;
  };
  std::vector<Foot> feet(std::span<const Vector3d> points) const;
  Curve on_boundary(std::vector<Vector3d> points, int iterations, double tolerance) const;
  std::optional<BoundaryPoint> advance(const BoundaryPoint& from, double& step,
                                       int direction) const;
  bool extend(Curve& curve, int direction, const BoundaryPoint& end, std::size_t most_points) const;
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

/// Newton's method from each point; those that do not come within `tolerance` spacings of Gamma are
/// left out.
Curve Tracer::on_boundary(std::vector<Vector3d> points, int iterations, double tolerance) const {
  Curve found;
  for (int it = 0;; it++) {
    const std::vector<Foot> at = feet(points);
    auto arrived = [&](const Foot& f) { return f.regular && f.step.norm() < tolerance * h_; };
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

/// Points of Gamma, by Newton's method from the middle of every cell of the grid in which phi
/// changes sign and psi does or nearly does: stripes and caps may fit between the nodes.
Curve Tracer::seeds(const NarrowBand& band) const {
  const Grid& grid = band.grid();
  auto may_vanish = [&](const LevelSet& f, std::size_t node, double beyond) {
    double least = 1e300, most = -1e300;
    for (int corner = 0; corner < 8; corner++) {
      const double v = f.nodal()[node + grid.index(corner & 1, corner >> 1 & 1, corner >> 2)];
      least = std::min(least, v);
      most = std::max(most, v);
    }
    const double margin = beyond * (most - least);
    return least - margin < 0 && most + margin >= 0;
  };
  auto find = [&](std::size_t begin, std::size_t end, std::vector<Vector3d>& found) {
    for (std::size_t s = begin; s < end; s++) {
      const int node = band.node()[s], i = node % grid.nx(), j = node / grid.nx() % grid.ny(),
                k = node / grid.nx() / grid.ny();
      if (i + 1 == grid.nx() || j + 1 == grid.ny() || k + 1 == grid.nz()) continue;
      if (!may_vanish(phi_, node, 0) || !may_vanish(psi_, node, psi_margin)) continue;
      const Vec3 x = grid.position(node);
      found.push_back(Vector3d(x[0], x[1], x[2]).array() + 0.5 * h_);
    }
  };
  return on_boundary(parallel_collect<Vector3d>(band.size(), 4096, find), 4, 0.02);
}

/// The next point along t (direction 1) or against it (-1), `step` or less away: predicted with the
/// curvature, corrected by Newton's method.
std::optional<BoundaryPoint> Tracer::advance(const BoundaryPoint& from, double& step,
                                             int direction) const {
  for (; step > shortest_step * h_; step /= 2) {
    const Vector3d predicted =
        from.x + direction * step * from.t + 0.5 * step * step * from.curvature();
    Foot f = feet(std::span(&predicted, 1))[0];
    if (!f.regular || f.step.norm() > trusted * step || f.point.t.dot(from.t) < std::cos(2 * turn))
      continue;
    f.point.x += f.step;
    return f.point;
  }
  return {};
}

/// Appends points until the curve has come to `end` (true) or cannot be followed.
bool Tracer::extend(Curve& curve, int direction, const BoundaryPoint& end,
                    std::size_t most_points) const {
  double step = point_distance * h_;
  while (curve.size() < most_points) {
    const BoundaryPoint at = curve.back();
    step = std::min({2 * step, point_distance * h_, turn / at.curvature().norm()});
    const Vector3d left = end.x - at.x;
    const double along = direction * left.dot(at.t);
    if (curve.size() > 2 && along > 0 && left.norm() < std::max(1.2 * step, same_end * h_) &&
        at.t.dot(end.t) > 0)
      return true;
    const std::optional<BoundaryPoint> next = advance(at, step, direction);
    if (!next) break;
    curve.push_back(*next);
  }
  return false;
}

Tracer::Walk Tracer::walk(const BoundaryPoint& start, std::size_t most_points) const {
  Curve forwards{start};
  if (extend(forwards, 1, start, most_points)) return {std::move(forwards), true};
  Curve curve{start};
  const bool closed = extend(curve, -1, forwards.back(), most_points);
  std::ranges::reverse(curve);
  curve.insert(curve.end(), forwards.begin() + 1, forwards.end());
  return {std::move(curve), closed};
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

/// Spacings come out equal to about 1e-8, to 2e-6 with turns of radius 2 h (measured).
std::optional<Curve> Tracer::finish(const Curve& walked) const {
  std::vector<Vector3d> points = equally_spaced(walked);
  const std::size_t n = points.size();
  Curve curve = on_boundary(std::move(points), 4, 1e-9);
  if (curve.size() < n) return {};
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

/// Past a sharp turn a walk may come upon a curve that another has followed.
bool is_on(const BoundaryPoint& p, std::span<const BoundaryPoint> curves, double h) {
  return std::ranges::any_of(curves, [&](const BoundaryPoint& q) {
    return (q.x - p.x).norm() < same_point * h && q.t.dot(p.t) > 0;
  });
}

} // namespace

std::pair<int, int> PhaseBoundary::neighbours(int point) const {
  const std::size_t i = point;
  if (i < begin_.back()) {
    const auto end = std::ranges::upper_bound(begin_, i);
    const std::size_t first = *(end - 1), last = *end - 1;
    return {int(i == first ? last : i - 1), int(i == last ? first : i + 1)};
  }
  const auto end = std::ranges::upper_bound(piece_begin_, i);
  return {int(i == *(end - 1) ? i : i - 1), int(i + 1 == *end ? i : i + 1)};
}

std::vector<double> PhaseBoundary::derivative(std::span<const double> f) const {
  constexpr double w[5] = {0, 4. / 5, -1. / 5, 4. / 105, -1. / 280};
  std::vector<double> out;
  for (std::size_t c = 0; c < curves(); c++) {
    const std::size_t first = begin_[c], n = begin_[c + 1] - first;
    for (std::size_t i = 0; i < n; i++) {
      double sum = 0;
      for (std::size_t m = 1; m <= 4; m++)
        sum += w[m] * (f[first + (i + m) % n] - f[first + (i + n - m) % n]);
      out.push_back(sum / points_[first + i].weight);
    }
  }
  for (std::size_t i = out.size(); i < points_.size(); i++) {
    const auto [before, after] = neighbours(int(i));
    const double way = points_[after].s - points_[before].s;
    out.push_back(way > 0 ? (f[after] - f[before]) / way : 0);
  }
  return out;
}

void PhaseBoundary::add_open(std::span<const BoundaryPoint> piece) {
  double s = 0;
  for (std::size_t i = 0; i < piece.size(); i++) {
    BoundaryPoint p = piece[i];
    const double before = i == 0 ? 0 : (p.x - piece[i - 1].x).norm(),
                 after = i + 1 == piece.size() ? 0 : (piece[i + 1].x - p.x).norm();
    s += before;
    p.s = s;
    p.weight = 0.5 * (before + after);
    points_.push_back(p);
  }
  piece_begin_.push_back(points_.size());
}

void PhaseBoundary::trace(const LevelSet& phi, const LevelSet& psi, const NarrowBand& band) {
  const double h = band.grid().spacing;
  const Tracer tracer(phi, psi);
  points_.clear();
  begin_ = {0};
  unresolved_.clear();
  Curve seeds = tracer.seeds(band);
  const std::size_t most_points = 1000 + 16 * seeds.size();
  std::ranges::sort(seeds, {}, [](const BoundaryPoint& p) { return p.x[0]; });
  std::vector<Curve> pieces;
  while (!seeds.empty()) {
    Tracer::Walk walk = tracer.walk(seeds.back(), most_points);
    const std::optional<Curve> curve = walk.closed ? tracer.finish(walk.points) : std::nullopt;
    seeds.pop_back();
    remove_seeds(seeds, walk.points, h); // these go around the sharpest corners too
    if (curve) {
      remove_seeds(seeds, *curve, h);
      points_.insert(points_.end(), curve->begin(), curve->end());
      begin_.push_back(points_.size());
      continue;
    }
    for (const Vector3d& end : {walk.points.front().x, walk.points.back().x}) {
      auto near = [&](const Vector3d& x) { return (x - end).norm() < same_place * h; };
      if (std::ranges::none_of(unresolved_, near)) unresolved_.push_back(end);
    }
    pieces.push_back(std::move(walk.points));
  }
  piece_begin_ = {points_.size()};
  for (const Curve& piece : pieces) {
    Curve rest; // between points that are on what was found before
    const auto add_rest = [&] {
      if (rest.size() > 1) add_open(rest);
      rest.clear();
    };
    for (const BoundaryPoint& p : piece)
      if (is_on(p, points_, h))
        add_rest();
      else
        rest.push_back(p);
    add_rest();
  }
}

} // namespace lamella
