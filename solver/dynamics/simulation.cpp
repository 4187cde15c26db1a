#include "dynamics/simulation.h"

#include "error.h"
#include "parallel.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace lamella {

namespace {
// Spacings, kept free at the sides of the box: the reach of the quadrature kernel.
constexpr double margin = 2.75;

// A step fails that ends further off the constraints, or raises the energy by so much of the
// bending energy.
constexpr double hopeless_drift = 1e-4, energy_jump = 0.01;
constexpr int most_failures = 8; // in a row, each time ten times shorter
// Of what steps add to the constraints beyond first order; on a sphere it cannot be made up for.
constexpr double memory = 0.9;

// |grad phi| over its mean; where it varies more the step loses stability.
constexpr double gauge_limit = 1.2;
constexpr int steps_between_renormalisations = 5;
constexpr int steps_between_responses = 4;
} // namespace

Simulation::Simulation(const Scene& scene) : Simulation(scene, start_of(scene)) {}

Simulation::Simulation(const Scene& scene, const Start& start)
    : contact_(scene.contact),
      control_(
          {scene.numerics.tolerance, scene.grid().spacing, scene.membrane.bending_modulus,
           scene.numerics.max_time_step > 0 ? scene.numerics.max_time_step : scene.end_time / 16}),
      fourier_(scene.grid()), vesicle_(scene, start, fourier_), gauge_(scene.grid()),
      stepper_(scene.grid(), fourier_,
               scene.area_difference.constraint == Constraint::free ? 1 : 2),
      cells_(start.cells) {
  if (vesicle_.drift(0) > hopeless_drift) throw RunError(why_not_kept());
  measures_ = vesicle_.measures(0);
  topology_ = {measures_.components, measures_.genus};
  check(measures_);
  find_narrow_places();
  note_unresolved();
}

Frame Simulation::frame() const {
  LevelSet phi = vesicle_.phi();
  if (broken_) std::ranges::copy(stepper_.before(), phi.coefficients().begin());
  phi.update_nodal();
  return {grid(), time(), {phi.nodal().begin(), phi.nodal().end()}, cells_};
}

void Simulation::step(double latest) {
  if (!why_not_on_.empty()) throw RunError(why_not_on_);
  if (vesicle_.set_out(time())) response_dt_ = 0; // there is one more
  int failures = 0;
  while (!try_step(choose_dt(latest), latest)) {
    if (++failures == most_failures) throw RunError(why_not_kept());
    go_back();
  }
  change_topology_if_needed();
  note_unresolved();
  recentre_if_needed();
  renormalise_if_needed();
}

/// False if the step did not end on the constraints.
bool Simulation::try_step(double dt, double latest) {
  const SurfaceGeometry& surface = vesicle_.surface();
  const Constraints& constraints = vesicle_.constraints();
  const double C = vesicle_.bending().spontaneous_curvature,
               kappa = vesicle_.bending().bending_modulus;
  const double energy = vesicle_.energy();
  double then = time() + dt;
  if (then > latest * (1 - 1e-12)) then = latest; // rounding
  gauge_.filter(vesicle_.phi(), vesicle_.band());
  extend_rates([&](std::size_t i) { return vesicle_.velocity(i); });
  stepper_.predict(vesicle_.extension(), dt,
                   {kappa, std::max(0.0, vesicle_.multipliers()[1] + 0.5 * kappa * C * C)});
  if (steps_ % steps_between_responses == 0 || dt > 1.5 * response_dt_ || 1.5 * dt < response_dt_) {
    extend_rates([&](std::size_t i) { return surface.KM()[i]; });
    stepper_.respond(0, vesicle_.extension());
    if (constraints.is_held(2)) {
      extend_rates([&](std::size_t i) { return surface.K()[i]; });
      stepper_.respond(1, vesicle_.extension());
    }
    response_dt_ = dt;
  }
  apply_constrained(then);
  error_ = step_error();
  last_dt_ = dt;
  broken_ = true;
  const Quantities excess = vesicle_.measure(then);
  if (!(vesicle_.drift(then) < hopeless_drift)) return false;
  Measures now = vesicle_.measures(then);
  now.dt = dt;
  const bool driven = constraints.rate(then) != Quantities::Zero() ||
                      constraints.rate(time()) != Quantities::Zero();
  if (!driven && now.energy - energy > energy_jump * measures_.bending_energy) return false;
  if (broke_film(now)) {
    const CriticalPoint* film = narrowest_place().second;
    const std::string message = film_message(film ? film->place : Vec3{});
    go_back();
    throw RunError(message);
  }
  check(now);
  excess_ = memory * excess_ + excess;
  steps_++;
  measures_ = now;
  broken_ = false;
  return true;
}

/// d phi / dt = -v |grad phi| for a velocity v at the samples, carried into the box.
template <class Velocity>
void Simulation::extend_rates(Velocity&& v) {
  const SurfaceGeometry& surface = vesicle_.surface();
  work_.resize(vesicle_.band().size());
  for (std::size_t i = 0; i < surface.entry().size(); i++)
    work_[surface.entry()[i]] = -v(i) * surface.grad()[i];
  vesicle_.extension().complete(0, work_);
  vesicle_.extension().fill(vesicle_.band(), work_);
}

/// Adds to the step's increment what leads the constraints to their targets to first order: the
/// responses to a tension and to a multiplier of the area difference, and a constant. What the last
/// steps gained beyond first order is expected again. (Constraint forces in the metric of the
/// implicit step: energy then falls as in a gradient flow of that metric. Corrected afterwards,
/// along K_M itself, long tubes began to oscillate.)
void Simulation::apply_constrained(double time) {
  const SurfaceGeometry& surface = vesicle_.surface();
  const Constraints& constraints = vesicle_.constraints();
  const std::size_t n = surface.size();
  const ConstPoints p = surface.points();
  std::vector<double> along[3];
  auto on_membrane = [&](std::span<const double> nodal, std::vector<double>& values) {
    SplineView field = vesicle_.phi().view();
    field.coefficients = nodal.data();
    values.resize(n);
    parallel_for(n, 1024, [&](std::size_t begin, std::size_t end) {
      kernels().cubic(field, end - begin, {p.x + begin, p.y + begin, p.z + begin}, &values[begin]);
    });
  };
  on_membrane(stepper_.increment(), along[0]);
  on_membrane(stepper_.response(0), along[1]);
  if (constraints.is_held(2)) on_membrane(stepper_.response(1), along[2]);

  Eigen::Vector3d constant = Eigen::Vector3d::Zero(), moments[3] = {constant, constant, constant};
  for (std::size_t i = 0; i < n; i++) {
    const double w = -surface.weight()[i] / surface.grad()[i];
    const Eigen::Vector3d effect{w, w * surface.KM()[i], w * surface.K()[i]};
    constant += effect;
    for (int m = 0; m < 3; m++)
      if (!along[m].empty()) moments[m] += along[m][i] * effect;
  }
  Eigen::Matrix3d effect;
  effect << change_from(constant), change_from(moments[1]), change_from(moments[2]);
  const Eigen::Vector3d factors =
      constraints.combination(effect, constraints.target(time) - quantities(vesicle_.integrals()) -
                                          excess_ - change_from(moments[0]));
  if (!factors.allFinite()) throw RunError("the step is not finite");
  stepper_.apply(vesicle_.phi(), std::span(factors.data() + 1, 2), factors[0]);
}

/// After phi was changed by other means than a step. Returns the area before it was put back.
double Simulation::restart() {
  excess_.setZero();
  stepper_.restart();
  return vesicle_.measure_anew(time());
}

/// To the state before the step that failed, for a shorter one without history.
void Simulation::go_back() {
  std::ranges::copy(stepper_.before(), vesicle_.phi().coefficients().begin());
  broken_ = false;
  restart();
  last_dt_ *= 0.1;
  error_ = 0;
}

double Simulation::choose_dt(double latest) const {
  double dt = last_dt_ == 0 ? control_.first(vesicle_.max_force())
                            : control_.next(last_dt_, error_, vesicle_.max_speed());
  dt = std::min(dt, vesicle_.longest_step(time()));
  if (vesicle_.constraints().turns_at(time()))
    dt = std::min(dt, control_.first(vesicle_.max_speed()));
  const double left = latest - time();
  if (dt >= left * (1 - 1e-9)) return left;
  return dt > 0.5 * left ? 0.5 * left : dt;
}

double Simulation::next_dt() const { return choose_dt(1e300); }

/// 2 rms |c_new - ratio c_old| / (|grad phi| h) over the nodes next to the membrane.
double Simulation::step_error() const {
  const SurfaceGeometry& surface = vesicle_.surface();
  const NarrowBand& band = vesicle_.band();
  const double ratio = stepper_.step_ratio(), h = grid().spacing;
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < surface.entry().size(); i++) {
    const int s = surface.entry()[i];
    if (std::abs(band.distance()[s]) > h) continue;
    const int node = band.node()[s];
    const double e = (stepper_.increment()[node] - ratio * stepper_.previous_increment()[node]) /
                     surface.grad()[i];
    sum += e * e;
    count++;
  }
  return ratio == 0 || count == 0 ? 0 : 2 * std::sqrt(sum / double(count)) / h;
}

void Simulation::renormalise_if_needed() {
  std::vector<double> grad = vesicle_.grad_of_entries();
  const GaugeRange range = gauge_range(vesicle_.band(), grad);
  if (std::max(range.greatest, 1 / range.least) < gauge_limit) return;
  if (steps_ - renormalised_ < steps_between_renormalisations) return;
  vesicle_.extension().complete(range.mean, grad);
  stepper_.rescale(
      gauge_.renormalise(vesicle_.phi(), vesicle_.band(), grad, vesicle_.extension(), fourier_));
  renormalised_ = steps_;
  vesicle_.measure(time());
}

std::string Simulation::why_not_kept() const {
  return steps_ == 0 ? "the start shape is thinner than the grid can resolve; try more grid.nodes"
                     : "volume and area can no longer be kept: somewhere the membrane is thinner "
                       "than the grid can resolve; try more grid.nodes";
}

void Simulation::check(const Measures& m) const {
  const SurfaceGeometry& surface = vesicle_.surface();
  for (double value :
       {m.energy, m.int_KM2, m.P, m.sigma, m.K_multiplier, m.area, m.volume, m.max_speed})
    if (!std::isfinite(value)) throw RunError("a measured value is not finite");
  if (!(m.volume > 0 && m.area > 0)) throw RunError("the membrane no longer encloses a volume");
  for (std::size_t i = 0; i < surface.size(); i++) {
    const Vec3 p = surface.point(i);
    for (int d = 0; d < 3; d++)
      if (std::abs(p[d]) > 0.5 * grid().length(d) - margin * grid().spacing)
        throw RunError(fmt::format("the membrane has come within {} grid spacings of a side of the "
                                   "box; try a larger grid.half_width, with grid.nodes to match",
                                   margin));
  }
}

} // namespace lamella
