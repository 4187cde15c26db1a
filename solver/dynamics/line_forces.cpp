#include "dynamics/line_forces.h"

#include "energy/text_line_density.h"
#include "levelset/taylor.h"
#include "parallel.h"
#include "scene/densities.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lamella {

namespace {

using Eigen::Vector3d;

constexpr double reach = 6;  // grid spacings, half the width of the strip
constexpr int half_rule = 8; // points on either side; the profile ends smoothly

constexpr double point_distance = 0.5, hat_distance = 2; // of the boundary, in balance()
constexpr int powers = 3;

/// Without what the strip has smeared by itself.
Line sharp(Line moduli) {
  moduli.tension = moduli.geodesic_modulus = moduli.drag = 0;
  return moduli;
}

/// Second derivative of l by one of the curvatures.
double second(const LineDensity& density, const CurveGeometry& c, double CurveGeometry::*curvature,
              double LineDensity::Value::*derivative) {
  const double e = 1e-4 * (1 + std::abs(c.*curvature));
  CurveGeometry before = c, after = c;
  before.*curvature -= e;
  after.*curvature += e;
  return (density.at(after).*derivative - density.at(before).*derivative) / (2 * e);
}

/// A point on its way along a geodesic that leaves the boundary at a right angle.
struct Walker {
  Vector3d x, direction, N;
  double turned = 0; ///< int B ds, B the curvature along the way
};

/// One step along the geodesics, by a signed length; returns B there.
std::vector<double> walk(std::vector<Walker>& walkers, const LevelSet& phi, double length) {
  std::vector<Vector3d> x;
  std::vector<Taylor> at;
  const auto curvature = [](const Taylor& f, const Vector3d& d) {
    return -d.dot(f.hessian * d) / f.gradient.norm();
  };
  for (const Walker& w : walkers) x.push_back(w.x);
  at = taylor(phi, x);
  for (std::size_t i = 0; i < x.size(); i++) {
    const Vector3d& d = walkers[i].direction;
    x[i] += length * d + 0.5 * length * length * curvature(at[i], d) * walkers[i].N;
  }
  at = taylor(phi, x);
  for (std::size_t i = 0; i < x.size(); i++)
    x[i] -= at[i].value / at[i].gradient.squaredNorm() * at[i].gradient;
  at = taylor(phi, x);
  std::vector<double> B;
  for (std::size_t i = 0; i < x.size(); i++) {
    Walker& w = walkers[i];
    const Vector3d N = at[i].gradient.normalized(), before = w.direction;
    w.direction = (before - before.dot(N) * N).normalized();
    w.turned -= (N - w.N).dot((before + w.direction).normalized());
    w.N = N;
    w.x = x[i];
    B.push_back(curvature(at[i], w.direction));
  }
  return B;
}

/// A function of the place along a closed curve and of the distance u from it, of the few that
/// balance() makes use of: hats along the curve times powers of u.
struct Hats {
  int count;
  double per_point;

  explicit Hats(std::size_t points)
      : count(std::max(4, int(double(points) * point_distance / hat_distance))),
        per_point(double(count) / double(points)) {}
  /// The two that are not 0 at a place along the curve, in points, and the second's value.
  struct Pair {
    int first, second;
    double share;
  };
  Pair at(double place) const {
    const double y = place * per_point, floor = std::floor(y);
    const int j = ((int(floor) % count) + count) % count;
    return {j, (j + 1) % count, y - floor};
  }
};

} // namespace

LineForces::LineForces(const Line& moduli, const Parameters& parameters, double spacing)
    : exist_(sharp(moduli) != Line{}), h_(spacing),
      density_(std::make_shared<LinePolynomial>(sharp(moduli))),
      profile_(SmearedStep::of_line_forces(reach * spacing)),
      of_couples_(SmearedStep::of_line_couples(reach * spacing)) {
  if (moduli.density.empty()) return;
  text_ = std::make_shared<TextLineDensity>(moduli.density, names_on_line(parameters));
  density_ = std::make_shared<LineSum>(density_, text_);
}

void LineForces::find(const PhaseBoundary& boundary, const LevelSet& phi) {
  const std::span<const BoundaryPoint> points = boundary.points();
  along_n_.assign(points.size(), 0);
  if (!exist_) return;
  find_ribbon(boundary, phi);
  LineLoads loads(*density_, boundary, ribbon_);
  along_N_.resize(points.size());
  greatest_ = 0;
  const double delta = profile_.at(0).delta, of_couples = of_couples_.at(0).delta;
  for (std::size_t j = 0; j < points.size(); j++) {
    along_n_[j] = loads.force[j].dot(points[j].n) - ribbon_[j].B_perp * loads.couple[j];
    along_N_[j] = loads.force[j].dot(points[j].N);
    greatest_ = std::max(greatest_, delta * std::abs(along_N_[j]) +
                                        of_couples / h_ * std::abs(loads.couple[j]));
  }
  couple_ = std::move(loads.couple);
  find_stiffness();
}

/// Turns the boundary's frame about t by the mean over the strip of how far the membrane is turned
/// there, each place counting as much as it has area.
void LineForces::find_ribbon(const PhaseBoundary& boundary, const LevelSet& phi) {
  const std::span<const BoundaryPoint> points = boundary.points();
  const double step = reach * h_ / half_rule;
  std::vector<double> turn(points.size(), 0), B_perp;
  for (const BoundaryPoint& p : points) B_perp.push_back(step * of_couples_.at(0).delta * p.B_perp);
  for (const int side : {-1, 1}) {
    std::vector<Walker> walkers;
    for (const BoundaryPoint& p : points) walkers.push_back({p.x, p.n, p.N});
    for (int m = 1; m < half_rule; m++) {
      const std::vector<double> B = walk(walkers, phi, side * step);
      const double u = side * m * step, delta = step * of_couples_.at(u).delta;
      for (std::size_t j = 0; j < points.size(); j++) {
        const double share = delta * (1 - points[j].kg * u - 0.5 * points[j].K() * u * u);
        turn[j] += share * walkers[j].turned;
        B_perp[j] += share * B[j];
      }
    }
  }
  const std::vector<double> slope = boundary.derivative(turn);
  ribbon_.assign(points.begin(), points.end());
  for (std::size_t j = 0; j < points.size(); j++) {
    const CurveGeometry& p = points[j];
    CurveGeometry& r = ribbon_[j];
    const double c = std::cos(turn[j]), s = std::sin(turn[j]);
    r.n = c * p.n + s * p.N;
    r.N = c * p.N - s * p.n;
    r.kg = c * p.kg + s * p.kn;
    r.kn = c * p.kn - s * p.kg;
    r.tau_g += slope[j];
    r.B_perp = B_perp[j];
  }
}

double LineForces::energy(const LineDensity& part, const PhaseBoundary& boundary) const {
  double sum = 0;
  for (std::size_t j = 0; j < boundary.points().size(); j++)
    sum += boundary.points()[j].weight * part.at(ribbon_[j]).l;
  return sum;
}

std::vector<double> LineForces::variation(const PhaseBoundary& boundary,
                                          std::span<const Place> places) const {
  std::vector<double> F(places.size());
  parallel_for(places.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i++) {
      const auto& [foot, psi, slope2, lap, weight] = places[i];
      const SmearedStep::Value d = of_couples_.at(psi);
      F[i] = -profile_.at(psi).delta * std::sqrt(slope2) * foot.smooth_value(along_N_, boundary) -
             foot.smooth_value(couple_, boundary) * (d.slope * slope2 + d.delta * lap);
    }
  });
  for (std::size_t c = 0; c < boundary.curves(); c++) balance(boundary, c, places, F);
  return F;
}

/// Quadrature errs where forces swing to and fro across the strip. What that does to displacements
/// that are constant, linear or quadratic across it and slow along the boundary is known exactly,
/// and is taken off by forces of the same kind.
void LineForces::balance(const PhaseBoundary& boundary, std::size_t curve,
                         std::span<const Place> places, std::span<double> variation) const {
  const std::span<const BoundaryPoint> points = boundary.curve(curve);
  const int begin = int(points.data() - boundary.points().data()), n = int(points.size());
  const Hats hats(points.size());
  const int unknowns = powers * hats.count;
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(unknowns, unknowns);
  Eigen::VectorXd missing = Eigen::VectorXd::Zero(unknowns);
  for (int j = 0; j < n; j++) {
    const Hats::Pair pair = hats.at(j);
    const double w = points[j].weight;
    for (const auto& [hat, value] :
         {std::pair(pair.first, 1 - pair.share), std::pair(pair.second, pair.share)}) {
      missing[powers * hat] -= w * value * along_N_[begin + j];
      missing[powers * hat + 1] += w * value * couple_[begin + j] / h_;
    }
  }
  struct Member {
    std::size_t place;
    Hats::Pair pair;
    double u, bell;
  };
  std::vector<Member> members;
  for (std::size_t i = 0; i < places.size(); i++) {
    const BoundaryFeet::Foot& foot = places[i].foot;
    const int at = foot.at - begin;
    if (at < 0 || at >= n) continue;
    const bool forwards = foot.next - begin == (at + 1) % n;
    const double u = foot.distance / h_, v = std::max(0.0, 1 - u * u / (reach * reach));
    members.push_back({i, hats.at(at + (forwards ? foot.share : -foot.share)), u, v * v * v});
  }
  const auto each = [&](const Member& m, auto&& f) {
    for (const auto& [hat, value] :
         {std::pair(m.pair.first, 1 - m.pair.share), std::pair(m.pair.second, m.pair.share)})
      for (int k = 0; k < powers; k++) f(powers * hat + k, value * std::pow(m.u, k));
  };
  for (const Member& m : members) {
    const double w = places[m.place].weight;
    each(m, [&](int a, double of_a) {
      missing[a] -= w * of_a * variation[m.place];
      each(m, [&](int b, double of_b) { gram(a, b) += w * m.bell * of_a * of_b; });
    });
  }
  gram.diagonal().array() += 1e-9 * gram.trace() / unknowns;
  const Eigen::VectorXd factors = gram.ldlt().solve(missing);
  for (const Member& m : members)
    each(m, [&](int a, double of_a) { variation[m.place] += m.bell * of_a * factors[a]; });
}

/// By what a wave v of the boundary and w of the membrane changes the curvatures most:
///   kg by d_s^2 v + kn d_n w - 2 tau_g d_s w,  kn by d_s^2 w - kg d_n w + 2 tau_g d_s v,
///   tau_g by d_s d_n w + (B_perp - kn) d_s v + 2 kg d_s w.
void LineForces::find_stiffness() {
  Stiffness along, across;
  for (const CurveGeometry& p : ribbon_) {
    using V = LineDensity::Value;
    const double g = std::abs(second(*density_, p, &CurveGeometry::kg, &V::kg)),
                 n = std::abs(second(*density_, p, &CurveGeometry::kn, &V::kn)),
                 t = std::abs(second(*density_, p, &CurveGeometry::tau_g, &V::tau_g));
    const V l = density_->at(p);
    const double kg2 = p.kg * p.kg, kn2 = p.kn * p.kn, tau2 = p.tau_g * p.tau_g,
                 curved = p.B_perp - p.kn;
    along.stiffness = std::max(along.stiffness, g);
    along.tension =
        std::max(along.tension, g * kg2 + 4 * n * tau2 + t * curved * curved + std::abs(l.l) +
                                    std::abs(l.tau_g * p.tau_g) + std::abs(l.kn * p.B_perp));
    across.stiffness = std::max(across.stiffness, 0.5 * n + 0.15 * t);
    across.tension = std::max(across.tension, g * (kn2 + 4 * tau2) + n * kg2 + 4 * t * kg2);
  }
  const double most = of_couples_.at(0).delta;
  of_boundary_ = along;
  of_membrane_ = {most * across.stiffness, most * across.tension};
}

} // namespace lamella
