#include "dynamics/phases.h"

#include "energy/scalar_jet.h"
#include "levelset/gauge.h"
#include "parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lamella {

namespace {

using Eigen::Vector3d;

// Lengths in grid spacings.
// psi is the distance up to here, and then levels off.
constexpr double linear_until = 5, level_from = 9;
// Of the boundary: within it psi follows the boundary's motion, beyond it nothing.
constexpr double follow_until = 4, follow_end = 6.6;
constexpr double foot_reach = 8;

constexpr double far_pull = 0.1;   // towards the distance where it does not matter much, a step
constexpr double fading_time = 10; // in which what a vanished boundary left fades; h^4 / kappa
// How often what the pull moves the boundary by is taken off again: each time leaves a sixteenth.
constexpr int returns = 3;
constexpr double inconsistent = 1.5; // distance from psi: the foot is not that of this boundary

Vector3d vec(const Vec3& v) { return {v[0], v[1], v[2]}; }

} // namespace

PhaseIntegrals& PhaseIntegrals::operator+=(const PhaseIntegrals& o) {
  gram += o.gram;
  area_Ld += o.area_Ld;
  length += o.length;
  return *this;
}

Phases::Phases(const Scene& scene, std::span<const double> psi, Fourier& fourier)
    : h_(scene.grid().spacing), ld_(scene.ld), lo_(scene.lo),
      curvature_start_time_(scene.curvature_start_time), parameters_(scene.parameters),
      fields_(scene.fields), line_(scene.line), line_forces_(scene.line, scene.parameters, h_),
      profiles_(StepProfiles::of_grid(h_)),
      held_(scene.stretch.modulus > 0, scene.area.of == Of::each, h_),
      field_("psi", scene.grid(), fourier) {
  std::vector<double> nodal(psi.size());
  for (std::size_t i = 0; i < psi.size(); i++) nodal[i] = saturated(psi[i]);
  field_.fit(nodal, 60);
}

SurfaceEnergy Phases::surface_energy(double time) const {
  SurfaceModuli ld = ld_, lo = lo_;
  if (!is_curved(time)) ld.spontaneous_curvature = lo.spontaneous_curvature = 0;
  return {ld, lo, line_.geodesic_modulus, profiles_, parameters_, fields_};
}

double Phases::saturated(double s) const {
  const double a = std::abs(s) / h_, w = level_from - linear_until;
  if (a < linear_until) return s;
  const double u = std::min(1.0, (a - linear_until) / w);
  return std::copysign((linear_until + w * (u - u * u * u + 0.5 * u * u * u * u)) * h_, s);
}

double Phases::boundary_taper(double s) const {
  const double u = (std::abs(s) / h_ - follow_until) / (follow_end - follow_until);
  return u < 0 ? 1 : u > 1 ? 0 : 0.5 * (1 + std::cos(std::numbers::pi * u));
}

void Phases::locate(const LevelSet& phi, const NarrowBand& band, const Components& vesicles) {
  psi().update_nodal();
  boundary_.trace(phi, psi(), band);
  feet_.find(boundary_, phi, band, foot_reach * h_);
  DomainMap map = domains_of(band, psi().nodal());
  held_.find(band, map, boundary_, vesicles);
  domains_ = std::move(map.domains);
  restore_distance(band);
}

void Phases::follow(const LevelSet& phi, const NarrowBand& band) {
  psi().update_nodal();
  feet_.find(boundary_, phi, band, foot_reach * h_);
}

/// Pulls psi towards the signed distance from the boundary; the boundary itself keeps its place, as
/// the value of the change at each node's foot is taken off again. Far from the boundary what
/// counts is the phase of the membrane there: off it, psi may be that of another place beyond a
/// side of the box. Where a boundary has vanished moduli are still in between; how they
/// change does work, as any motion does, and so takes time.
void Phases::restore_distance(const NarrowBand& band) {
  const Grid& grid = band.grid();
  const double top = saturated(1e9);
  std::vector<double> change(band.size(), 0);
  parallel_for(band.size(), 2048, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i++) {
      const double here = psi().nodal()[band.node()[i]];
      const BoundaryFeet::Foot& foot = feet_[i];
      double& c = change[i];
      if (foot.exists()) {
        const double off = saturated(foot.distance) - here, near = boundary_taper(foot.distance);
        if (std::abs(here) < follow_until * h_ && std::abs(off) > inconsistent * h_) continue;
        c = (near + far_pull * (1 - near)) * off;
      } else {
        const ConstPoints p = band.points();
        const double there = psi().nodal()[grid.nearest({p.x[i], p.y[i], p.z[i]})];
        const double strip = boundary_taper(here);
        c = (strip * fade_ + (1 - strip) * far_pull) * (std::copysign(top, there) - here);
      }
      c *= band.taper()[i];
    }
  });
  auto source = [&](int k, double* out) {
    const std::size_t plane = std::size_t(grid.nx()) * grid.ny();
    std::fill_n(out, plane, 0.0);
    for (int s = band.plane_begin(k); s < band.plane_begin(k + 1); s++)
      out[band.node()[s] - k * plane] = change[s];
  };
  LevelSet correction(grid);
  auto sink = [&](int k, const double* in) {
    const std::size_t plane = std::size_t(grid.nx()) * grid.ny();
    std::copy_n(in, plane, correction.coefficients().begin() + k * plane);
  };
  field_.corrections().apply(source, sink);
  parallel_for(band.size(), 2048, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i++)
      correction.coefficients()[band.node()[i]] +=
          band.taper()[i] * noise_damping(grid, psi().coefficients(), band.node()[i]);
  });
  std::vector<Vector3d> places;
  for (const BoundaryPoint& p : boundary_.points()) places.push_back(p.x);
  const std::span<double> d = correction.coefficients();
  std::vector<double> at_boundary(places.size());
  for (int pass = 0; pass < returns; pass++) {
    std::ranges::transform(taylor(correction, places), at_boundary.begin(), &Taylor::value);
    parallel_for(band.size(), 2048, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; i++)
        if (feet_[i].exists())
          d[band.node()[i]] -=
              band.taper()[i] * boundary_taper(feet_[i].distance) * feet_[i].value(at_boundary);
    });
  }
  const std::span<double> c = psi().coefficients();
  parallel_for(c.size(), 1 << 14, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i++) c[i] += d[i];
  });
  fade_ = 0;
}

void Phases::sample(const NarrowBand& band, const SurfaceGeometry& surface,
                    const Components& vesicles) {
  const std::size_t n = surface.size(), own = surface.entry().size();
  const double reach = std::max(profiles_.half_width(), line_forces_.half_width());
  share_.resize(n);
  delta_.assign(n, 0);
  strip_.clear();
  std::vector<double> second(n - own);
  SplineView nodal = psi().view();
  nodal.coefficients = psi().nodal().data();
  const ConstPoints p = surface.points();
  kernels().cubic(nodal, n - own, {p.x + own, p.y + own, p.z + own}, second.data());
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < n; i++) {
    const double about = i < own ? psi().nodal()[band.node()[surface.entry()[i]]] : second[i - own];
    share_[i] = about < 0;
    if (std::abs(about) > reach + 0.5 * h_) continue;
    StripPoint s;
    s.sample = int(i);
    if (i < own) s.foot = feet_[surface.entry()[i]];
    strip_.push_back(s);
    points.push_back(vec(surface.point(i)));
  }
  std::vector<int> boundary_point(n, -1);
  for (const StripPoint& s : strip_)
    if (s.foot.exists()) boundary_point[s.sample] = s.foot.at;
  held_.sample(band.grid(), surface, boundary_point, vesicles);
  const std::vector<Taylor> near = taylor(psi(), points);
  parallel_for(strip_.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t m = begin; m < end; m++) {
      StripPoint& s = strip_[m];
      s.psi = near[m];
      const SurfaceJet<double> jet = jet_along(s.psi, surface, std::size_t(s.sample));
      s.slope2 = dot(jet.grad, jet.grad);
      s.lap = jet.lap;
      const SmearedStep::Value v = profiles_.accurate.at(jet.f);
      share_[s.sample] = 1 - v.step;
      delta_[s.sample] = v.delta * std::sqrt(s.slope2);
    }
  });
}

void Phases::find_forces(const LevelSet& phi, const SurfaceGeometry& surface, SurfaceEnergy& energy,
                         std::span<double> variation, std::span<const CarriedField> fields) {
  find_boundary_force(phi, fields, energy);
  is_Ld_.resize(surface.size());
  for (std::size_t i = 0; i < surface.size(); i++) is_Ld_[i] = share_[i] > 0.5;
  jets_.sample.clear();
  jets_.psi.resize(strip_.size());
  for (const StripPoint& s : strip_) jets_.sample.push_back(s.sample);
  parallel_for(strip_.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t m = begin; m < end; m++)
      jets_.psi[m] = jet_along(strip_[m].psi, surface, std::size_t(strip_[m].sample));
  });
  jets_.further.clear();
  if (energy.gradient_differs()) find_further(surface);
  energy.find_forces(surface, is_Ld_, jets_, variation, jets_of(fields));
  add_line_forces(surface, variation);
}

/// psi along the membrane, where third derivatives of it count: with T those in space,
///   grad_s Lap_s psi = P [grad Lap psi - T(N, N) + K_M H N] + 2 B H N + N.grad psi grad_s K_M
///                      - K_M B grad psi.
void Phases::find_further(const SurfaceGeometry& surface) {
  std::vector<Vector3d> points;
  for (const StripPoint& s : strip_) points.push_back(vec(surface.point(s.sample)));
  const std::vector<ThirdDerivatives> third = third_derivatives(psi(), points);
  jets_.further.resize(strip_.size());
  parallel_for(strip_.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t m = begin; m < end; m++) {
      const StripPoint& s = strip_[m];
      const std::size_t i = s.sample;
      const Eigen::Matrix3d& H = s.psi.hessian;
      const Vector3d N = vec(surface.normal(i)), HN = H * N,
                     grad_KM(surface.grad_KM(0)[i], surface.grad_KM(1)[i], surface.grad_KM(2)[i]);
      const double along_N = s.psi.gradient.dot(N);
      const Eigen::Matrix3d P = Eigen::Matrix3d::Identity() - N * N.transpose(),
                            B = curvature_tensor(surface, i), hess = P * H * P + along_N * B;
      const double KM = surface.KM()[i];
      Vector3d inner = KM * HN;
      for (int d = 0; d < 3; d++) inner[d] += third[m].by[d].trace() - N.dot(third[m].by[d] * N);
      const Vector3d grad_lap =
          P * inner + 2 * B * HN + along_N * grad_KM - KM * (B * (s.psi.gradient - along_N * N));
      jets_.further[m] = {{hess(0, 0), hess(1, 1), hess(2, 2), hess(0, 1), hess(0, 2), hess(1, 2)},
                          {grad_lap[0], grad_lap[1], grad_lap[2]}};
    }
  });
}

/// Adds what the line energy does to the membrane, spread over the strip.
void Phases::add_line_forces(const SurfaceGeometry& surface, std::span<double> variation) const {
  parallel_for(strip_.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t m = begin; m < end; m++) {
      const StripPoint& s = strip_[m];
      const int i = s.sample;
      const double along = dot(jets_.psi[m].grad, jets_.psi[m].B_grad),
                   kn = s.slope2 > 0 ? surface.KM()[i] - along / s.slope2 : 0;
      variation[i] -= line_.tension * delta_[i] * kn;
    }
  });
  if (line_forces_.exist()) spread_line_forces(surface, variation);
}

void Phases::spread_line_forces(const SurfaceGeometry& surface, std::span<double> variation) const {
  std::vector<LineForces::Place> places;
  std::vector<int> samples;
  for (const StripPoint& s : strip_) {
    if (!s.foot.exists()) continue;
    places.push_back({s.foot, s.psi.value, s.slope2, s.lap, surface.weight()[s.sample]});
    samples.push_back(s.sample);
  }
  const std::vector<double> F = line_forces_.variation(boundary_, places);
  for (std::size_t m = 0; m < F.size(); m++) variation[samples[m]] += F[m];
}

/// The force along n on each point of the boundary. What the strip does as a whole is summed along
/// the geodesic through the point, by Gauss's rule.
void Phases::find_boundary_force(const LevelSet& phi, std::span<const CarriedField> fields,
                                 const SurfaceEnergy& energy) {
  const std::span<const BoundaryPoint> curve = boundary_.points();
  line_forces_.find(boundary_, phi);
  const LineForces::Stiffness of_line = line_forces_.of_boundary();
  force_.resize(curve.size());
  flow_.assign(curve.size(), 0);
  stiffness_ = (of_line.stiffness / (h_ * h_) + of_line.tension + line_.tension) / (h_ * h_);
  for (std::size_t j = 0; j < curve.size(); j++)
    force_[j] = line_.tension * curve[j].kg + line_forces_.along_boundary(j);
  if (!energy.differs()) return;
  constexpr int rule = 16;
  constexpr double half_node[rule / 2] = {.0950125098376374, .2816035507792589, .4580167776572274,
                                          .6178762444026438, .7554044083550030, .8656312023878318,
                                          .9445750230732326, .9894009349916499},
                                    half_weight[rule / 2] = {.1894506104550685, .1826034150449236,
                                                             .1691565193950025, .1495959888165767,
                                                             .1246289712555339, .0951585116824928,
                                                             .0622535239386479, .0271524594117541};
  double node[rule], weight[rule];
  for (int q = 0; q < rule / 2; q++) {
    node[q] = -half_node[q];
    node[rule / 2 + q] = half_node[q];
    weight[q] = weight[rule / 2 + q] = half_weight[q];
  }
  const double reach = profiles_.half_width();
  std::vector<Vector3d> points;
  for (const BoundaryPoint& c : curve)
    for (const double u : node) {
      const double s = u * reach;
      points.push_back(c.x + s * c.n + 0.5 * s * s * c.B_perp * c.N);
    }
  const std::vector<Taylor> near = taylor(phi, points);
  for (std::size_t i = 0; i < points.size(); i++)
    points[i] -= near[i].value / near[i].gradient.squaredNorm() * near[i].gradient;
  const std::vector<Taylor> f = taylor(phi, points), to_boundary = taylor(psi(), points);
  std::vector<double> slope2(points.size(), 0);
  if (energy.gradient_differs()) {
    std::vector<Vec3> places;
    for (const Vector3d& p : points) places.push_back({p[0], p[1], p[2]});
    slope2 = squared_gradient_of_KM(phi, places);
  }
  std::vector<double> at_points(fields.size() * points.size()); // of each point in turn
  for (std::size_t m = 0; m < fields.size(); m++) {
    const std::vector<Taylor> values = taylor(fields[m].spline(), points);
    for (std::size_t i = 0; i < points.size(); i++)
      at_points[i * fields.size() + m] = values[i].value;
  }
  for (std::size_t j = 0; j < curve.size(); j++) {
    double slope = 0; // of the force as the boundary moves
    for (int q = 0; q < rule; q++) {
      const std::size_t i = rule * j + q;
      const CurveGeometry c = curve_geometry(f[i], to_boundary[i]);
      const Univariate density =
          energy.across(to_boundary[i].value, c.KM(), c.K(), slope2[i],
                        std::span(at_points).subspan(i * fields.size(), fields.size()));
      if (!std::isfinite(density.d1)) continue;
      const double s = node[q] * reach, width = weight[q] * reach * (1 - curve[j].kg * s);
      force_[j] += width * density.d1;
      slope += width * density.d2;
    }
    stiffness_ = std::max(stiffness_, std::abs(slope));
  }
}

void Phases::add_flow(const StretchField& stretch) {
  std::vector<Vector3d> x, n;
  for (const BoundaryPoint& p : boundary_.points()) {
    x.push_back(p.x);
    n.push_back(p.n);
  }
  flow_ = stretch.flow_across(x, n);
}

HeldAreas::Integrals Phases::integrate_held(const SurfaceGeometry& surface,
                                            std::span<const double> variation,
                                            const Components& vesicles) const {
  std::vector<double> free(force_.size());
  for (std::size_t j = 0; j < free.size(); j++) free[j] = force_[j] / drag_ + flow_[j];
  return held_.integrate(surface, share_, variation, boundary_, free, drag_, vesicles);
}

PhaseIntegrals Phases::integrate(const SurfaceGeometry& surface, const Samples& samples) const {
  return parallel_sum<PhaseIntegrals>(
      samples.count(surface), 4096, [&](std::size_t begin, std::size_t end) {
        PhaseIntegrals sum;
        for (std::size_t j = begin; j < end; j++) {
          const std::size_t i = samples[j];
          const double w = surface.weight()[i], KM = surface.KM()[i], K = surface.K()[i],
                       q = share_[i];
          if (w == 0) continue;
          sum.gram += w * q * KM * Eigen::Vector4d(1, KM, K, q * KM);
          sum.area_Ld += w * q;
          sum.length += w * delta_[i];
        }
        return sum;
      });
}

Eigen::VectorXd Phases::change_of_area(std::span<const double> psi, const SurfaceGeometry& surface,
                                       const Components& vesicles) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(vesicles.count());
  for (const StripPoint& s : strip_)
    sum[vesicles.of_sample(std::size_t(s.sample))] -=
        surface.weight()[s.sample] * profiles_.accurate.at(s.psi.value).delta * psi[s.sample];
  return sum;
}

Eigen::VectorXd Phases::length(const SurfaceGeometry& surface, const Components& vesicles) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(vesicles.count());
  for (const StripPoint& s : strip_)
    sum[vesicles.of_sample(std::size_t(s.sample))] += surface.weight()[s.sample] * delta_[s.sample];
  return sum;
}

/// oint kg dl = int_Ld K dA - 2 pi chi, with the integral smeared as the force is: the boundary
/// itself tells chi.
void Phases::find_line_energies(EnergyTerms& terms) const {
  constexpr double turn = 2 * std::numbers::pi;
  const auto find = [&](Term term, double Line::*modulus) {
    if (line_.*modulus == 0) return;
    Line part;
    part.*modulus = line_.*modulus;
    terms[term] = line_forces_.energy(LinePolynomial(part), boundary_);
  };
  if (line_.tension != 0) terms[Term::line_tension] = line_.tension * boundary_.length();
  if (const double modulus = line_.geodesic_modulus; modulus != 0) {
    const double smeared = terms.value(Term::geodesic) / modulus,
                 oint_kg = boundary_.integral([](const CurveGeometry&c) { return c.kg; }),
                 chi = std::round((smeared - oint_kg) / turn);
    terms[Term::geodesic] = modulus * (smeared - turn * chi);
  }
  find(Term::torsion, &Line::torsion_modulus);
  find(Term::normal, &Line::normal_modulus);
  find(Term::geodesic_square, &Line::geodesic_square_modulus);
  find(Term::normal_square, &Line::normal_square_modulus);
  find(Term::torsion_square, &Line::torsion_square_modulus);
  if (const LineDensity* text = line_forces_.text())
    terms[Term::line_density] = line_forces_.energy(*text, boundary_);
}

double Phases::least_radius() const {
  double least = 0;
  for (std::size_t c = 0; c < boundary_.curves(); c++) {
    double length = 0;
    for (const BoundaryPoint& p : boundary_.curve(c)) length += p.weight;
    if (c == 0 || length < least) least = length;
  }
  return least / (2 * std::numbers::pi);
}

double Phases::near_boundary(int node) const {
  const double u = psi().nodal()[node] / saturated(1e9);
  return 0.5 * (1 + std::cos(std::numbers::pi * std::clamp(u, -1.0, 1.0)));
}

double Phases::max_line_speed() const {
  double most = 0;
  for (std::size_t j = 0; j < force_.size(); j++) most = std::max(most, std::abs(speed(j)));
  return most;
}

void Phases::extend_rates(const NarrowBand& band, double dt, Extension& extension) {
  std::vector<double> speeds(force_.size());
  for (std::size_t j = 0; j < speeds.size(); j++) speeds[j] = speed(j) + held_.shift()[j] / dt;
  rates_.assign(band.size(), 0);
  weights_.assign(band.size(), 0);
  parallel_for(band.size(), 2048, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i++) {
      const BoundaryFeet::Foot& foot = feet_[i];
      if (!foot.exists()) continue;
      rates_[i] = -foot.value(speeds); // |grad_s psi| = 1
      weights_[i] = band.taper()[i] * boundary_taper(foot.distance);
    }
  });
  extension.fill(band, rates_, weights_);
  const double stiffest = std::max(ld_.bending_modulus, lo_.bending_modulus);
  fade_ = std::min(far_pull, dt * stiffest / (fading_time * h_ * h_ * h_ * h_));
}

} // namespace lamella
