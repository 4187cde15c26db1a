#include "dynamics/simulation.h"

#include "error.h"
#include "levelset/topology.h"
#include "parallel.h"
#include "scene/shapes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace lamella {

namespace {
// Lengths in grid spacings. The band: the spline's reach and a little more.
constexpr double band_half_width = 4.2;
// Kept free at the sides of the box: the reach of the quadrature kernel.
constexpr double margin = 2.75;
// Largest |F| in kappa / h^3: more is an unresolved tip.
constexpr double force_limit = 1;

// Relative error of volume and area: what the start may have against the exact shape (of a sphere
// quadrature gets one or the other right), what is good enough to be recorded, and what stops a
// run.
constexpr double start_drift = 1e-4, worst_drift = 5e-6, hopeless_drift = 1e-5;
constexpr int most_projections = 8;
// Of what steps add to volume and area beyond first order; on a sphere it cannot be made up for.
constexpr double memory = 0.9;

// |grad phi| over its mean; where it varies more the step loses stability.
constexpr double gauge_limit = 1.2;
constexpr int steps_between_renormalisations = 5;
constexpr int steps_between_responses = 4;

double sphere_radius(double area) { return std::sqrt(area / (4 * std::numbers::pi)); }
} // namespace

Simulation::Simulation(const Scene& scene)
    : bending_{scene.membrane.bending_modulus, scene.membrane.spontaneous_curvature},
      control_(
          {scene.numerics.tolerance, scene.grid().spacing, scene.membrane.bending_modulus,
           scene.numerics.max_time_step > 0 ? scene.numerics.max_time_step : scene.end_time / 16}),
      phi_(scene.grid()), fourier_(scene.grid()), band_(scene.grid(), band_half_width),
      extension_(scene.grid()), gauge_(scene.grid()), stepper_(scene.grid(), fourier_) {
  const std::vector<double> start = initial_phi(scene.shape, scene.grid());
  std::copy(start.begin(), start.end(), phi_.coefficients().begin());
  phi_.fit(start, fourier_);
  area_ = exact_area(scene.shape);
  volume_ = exact_volume(scene.shape);
  measure();
  if (drift() < start_drift) {
    area_ = integrals_.area();
    volume_ = integrals_.volume;
  }
  measures_ = summarise(0);
  check(measures_);
}

Frame Simulation::frame() const {
  LevelSet phi = phi_;
  if (broken_) std::ranges::copy(stepper_.before(), phi.coefficients().begin());
  phi.update_nodal();
  return {grid(), time(), {phi.nodal().begin(), phi.nodal().end()}, {}};
}

// ------------------------------------------------------------------------------------------------
// measuring

/// Brings the membrane onto its constraints and finds everything that is known of it. Second
/// derivatives suffice to measure the drift of volume and area; what is recorded is measured after
/// its correction. Returns the excess before it.
Simulation::Excess Simulation::measure() {
  locate();
  surface_.curvatures(phi_, band_);
  integrals_ = integrate(surface_, bending_, {});
  const Excess excess{integrals_.volume - volume_, integrals_.area() - area_};
  project();
  measure_forces();
  for (int pass = 0; pass < most_projections && drift() > worst_drift; pass++) {
    project();
    measure_forces();
  }
  return excess;
}

double Simulation::drift() const {
  return std::max(std::abs(integrals_.volume / volume_ - 1),
                  std::abs(integrals_.area() / area_ - 1));
}

void Simulation::locate() {
  phi_.update_nodal();
  band_.update(phi_);
  surface_.sample(band_);
  if (surface_.size() == 0) throw RunError("the membrane has disappeared");
  extension_.prepare(band_, surface_.sampled());
}

/// Displaces the membrane by a + b K_M so that volume and area are those of the scene.
void Simulation::project() {
  const double longest = 0.3 * grid().spacing;
  const Multipliers u =
      displacement_for(integrals_, volume_ - integrals_.volume, area_ - integrals_.area());
  const Points p = band_.points();
  work_.resize(band_.size());
  for (std::size_t i = 0; i < surface_.size(); i++) {
    const int s = surface_.entry()[i];
    const double d = std::clamp(u.P + u.sigma * surface_.KM()[i], -longest, longest);
    const Vec3 n = surface_.normal(i);
    work_[s] = d * surface_.grad()[i];
    p.x[s] += d * n[0];
    p.y[s] += d * n[1];
    p.z[s] += d * n[2];
  }
  extension_.complete(0, work_);
  std::span<double> c = phi_.coefficients();
  for (std::size_t s = 0; s < band_.size(); s++) c[band_.node()[s]] -= band_.taper()[s] * work_[s];
}

void Simulation::measure_forces() {
  surface_.jets(phi_, band_);
  const double h = grid().spacing, limit = force_limit * bending_.bending_modulus / (h * h * h);
  variation_.resize(surface_.size());
  max_force_ = 0;
  for (std::size_t i = 0; i < surface_.size(); i++) {
    const double F = bending_.variation(surface_.KM()[i], surface_.K()[i], surface_.lap_KM()[i]);
    variation_[i] = std::clamp(F, -limit, limit);
    max_force_ = std::max(max_force_, std::abs(F));
  }
  integrals_ = integrate(surface_, bending_, variation_);
  multipliers_ = multipliers_at_rest(integrals_);
  max_speed_ = 0;
  for (std::size_t i = 0; i < surface_.size(); i++)
    max_speed_ = std::max(max_speed_, std::abs(velocity(i)));
}

/// Normal velocity at a sample (Eq. 80).
double Simulation::velocity(std::size_t i) const {
  return -variation_[i] + multipliers_.sigma * surface_.KM()[i] + multipliers_.P;
}

Measures Simulation::summarise(double dt) const {
  Measures m;
  const double A = integrals_.area(), V = integrals_.volume, radius = sphere_radius(A),
               pi = std::numbers::pi;
  m.time = measures_.time + dt;
  m.dt = dt;
  m.energy = m.bending_energy = integrals_.energy;
  m.int_KM2 = integrals_.int_KM2();
  m.P = multipliers_.P;
  m.sigma = multipliers_.sigma;
  m.area = A;
  m.volume = V;
  m.reduced_volume = V / (4. / 3 * pi * radius * radius * radius);
  m.area_difference = -integrals_.int_KM() / (8 * pi * radius);
  m.area_drift = A / area_ - 1;
  m.volume_drift = V / volume_ - 1;
  m.max_speed = max_speed_;
  m.components = count_components(grid(), phi_.nodal());
  m.genus = m.components - int(std::lround(integrals_.int_K() / (4 * pi)));
  return m;
}

void Simulation::check(const Measures& m) const {
  for (double value : {m.energy, m.int_KM2, m.P, m.sigma, m.area, m.volume, m.max_speed})
    if (!std::isfinite(value)) throw RunError("a measured value is not finite");
  if (!(m.volume > 0 && m.area > 0)) throw RunError("the membrane no longer encloses a volume");
  if (drift() > hopeless_drift)
    throw RunError(
        steps_ == 0
            ? "the start shape is thinner than the grid can resolve; try more grid.nodes"
            : "volume and area can no longer be kept: somewhere the membrane is thinner than the "
              "grid can resolve; try more grid.nodes");
  for (std::size_t i = 0; i < surface_.size(); i++) {
    const Vec3 p = surface_.point(i);
    for (int d = 0; d < 3; d++)
      if (std::abs(p[d]) > 0.5 * grid().length(d) - margin * grid().spacing)
        throw RunError(fmt::format(
            "the membrane has come within {} grid spacings of a side of the box", margin));
  }
}

// -----------------------------------------------------------------------------------------------
// time steps

double Simulation::choose_dt(double latest) const {
  const double dt =
      steps_ == 0 ? control_.first(max_force_) : control_.next(measures_.dt, error_, max_speed_);
  const double left = latest - time();
  if (dt >= left * (1 - 1e-9)) return left;
  return dt > 0.5 * left ? 0.5 * left : dt;
}

double Simulation::next_dt() const { return choose_dt(1e300); }

/// d phi / dt = -v |grad phi| for a velocity v at the samples, carried into the box.
template <class Velocity>
void Simulation::extend_rates(Velocity&& v) {
  work_.resize(band_.size());
  for (std::size_t i = 0; i < surface_.size(); i++)
    work_[surface_.entry()[i]] = -v(i) * surface_.grad()[i];
  extension_.complete(0, work_);
  extension_.fill(band_, work_);
}

/// Adds to the step's increment what keeps volume and area to first order: the response to a
/// tension, and a constant. What the last steps gained beyond first order is expected again.
/// (Constraint forces in the metric of the implicit step: energy then falls as in a gradient flow
/// of that metric. Corrected afterwards, along K_M itself, long tubes began to oscillate.)
void Simulation::apply_constrained() {
  const std::size_t n = surface_.size();
  std::vector<double> x(n), y(n), z(n), increment(n), response(n);
  for (std::size_t i = 0; i < n; i++) {
    const Vec3 p = surface_.point(i);
    x[i] = p[0];
    y[i] = p[1];
    z[i] = p[2];
  }
  SplineView field = phi_.view();
  for (auto [source, values] :
       {std::pair{stepper_.increment(), &increment}, {stepper_.response(), &response}}) {
    field.coefficients = source.data();
    parallel_for(n, 1024, [&](std::size_t begin, std::size_t end) {
      kernels().cubic(field, end - begin, {&x[begin], &y[begin], &z[begin]}, &(*values)[begin]);
    });
  }
  Eigen::Matrix2d change = Eigen::Matrix2d::Zero(); // of volume and area, with factor and constant
  Eigen::Vector2d wanted{volume_ - integrals_.volume - excess_.volume,
                         area_ - integrals_.area() - excess_.area};
  for (std::size_t i = 0; i < n; i++) {
    const double w = -surface_.weight()[i] / surface_.grad()[i], KM = surface_.KM()[i];
    const Eigen::Vector2d effect{w, -w * KM};
    change.col(0) += effect * response[i];
    change.col(1) += effect;
    wanted -= effect * increment[i];
  }
  const Eigen::Vector2d solution = solve_scaled(change, wanted);
  if (!solution.allFinite()) throw RunError("the step is not finite");
  stepper_.apply(phi_, solution[0], solution[1]);
}

void Simulation::step(double latest) {
  const double dt = choose_dt(latest), C = bending_.spontaneous_curvature,
               kappa = bending_.bending_modulus;
  gauge_.filter(phi_, band_);
  extend_rates([&](std::size_t i) { return velocity(i); });
  stepper_.predict(extension_, dt,
                   {kappa, std::max(0.0, multipliers_.sigma + 0.5 * kappa * C * C)});
  if (steps_ % steps_between_responses == 0 || dt > 1.5 * response_dt_ || 1.5 * dt < response_dt_) {
    extend_rates([&](std::size_t i) { return surface_.KM()[i]; });
    stepper_.respond(extension_);
    response_dt_ = dt;
  }
  apply_constrained();
  error_ = step_error();
  steps_++;
  broken_ = true;
  const Excess excess = measure();
  excess_ = {memory * excess_.volume + excess.volume, memory * excess_.area + excess.area};
  Measures now = summarise(dt);
  if (now.time > latest * (1 - 1e-12)) now.time = latest; // rounding
  check(now);
  measures_ = now;
  broken_ = false;
  renormalise_if_needed();
}

/// 2 rms |c_new - ratio c_old| / (|grad phi| h) over the nodes next to the membrane.
double Simulation::step_error() const {
  const double ratio = stepper_.step_ratio(), h = grid().spacing;
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < surface_.size(); i++) {
    const int s = surface_.entry()[i];
    if (std::abs(band_.distance()[s]) > h) continue;
    const int node = band_.node()[s];
    const double e = (stepper_.increment()[node] - ratio * stepper_.previous_increment()[node]) /
                     surface_.grad()[i];
    sum += e * e;
    count++;
  }
  return ratio == 0 || count == 0 ? 0 : 2 * std::sqrt(sum / double(count)) / h;
}

void Simulation::renormalise_if_needed() {
  grad_.resize(band_.size());
  for (std::size_t i = 0; i < surface_.size(); i++) grad_[surface_.entry()[i]] = surface_.grad()[i];
  const GaugeRange range = gauge_range(band_, grad_);
  if (std::max(range.greatest, 1 / range.least) < gauge_limit) return;
  if (steps_ - renormalised_ < steps_between_renormalisations) return;
  extension_.complete(range.mean, grad_);
  stepper_.rescale(gauge_.renormalise(phi_, band_, grad_, extension_, fourier_));
  renormalised_ = steps_;
  measure();
}

} // namespace lamella
