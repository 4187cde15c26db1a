#include "dynamics/simulation.h"

#include "error.h"
#include "parallel.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace lamella {

namespace {
// Spacings, kept free at the sides of the box: the reach of the quadrature kernel.
constexpr double margin = 2.75;

constexpr double hopeless_drift = 1e-4; // off the constraints, of a step that fails
// Of steps to before one point in time, each ten times shorter than the one before. (Where the
// energy jumps not in a row: shorter ones go well, and every time end nearer to it.)
constexpr int most_failures = 8;
constexpr double shortest_step = 1e-10; // h^4 / kappa; what fails in so short a step fails for good
// Of what steps add to the constraints beyond first order; on a sphere it cannot be made up for.
constexpr double memory = 0.9;

// Spacings in a step. Noise of the gauge comes as the membrane moves: after a shorter move less of
// it is filtered, so that a membrane at rest stays where it is.
constexpr double noisy_move = 0.01;
// Stiff modes that lag move less than the energy falls by. How much the share of history that they
// keep grows by for that, at most, and falls by where they overshoot; what of the energy is too
// little to tell by.
constexpr double share_gain = 5, most_gained = 0.15, most_given_up = 0.5, least_share = 0.1,
                 least_lost = 1e-5;
// |grad phi| over its mean; where it varies more the step loses stability.
constexpr double gauge_limit = 1.2;
constexpr int steps_between_renormalisations = 5;
constexpr int steps_between_responses = 4;

/// Throws where a start lacks fields, or has them on other nodes.
const Start& checked(const Start& start, const Scene& scene) {
  const std::size_t nodes = scene.grid().size();
  const auto check = [nodes](const char* name, const std::vector<double>& field) {
    if (field.size() != nodes)
      throw RunError(fmt::format("the start has {} values of {}; the grid has {} nodes",
                                 field.size(), name, nodes));
    if (!std::ranges::all_of(field, [](double x) { return std::isfinite(x); }))
      throw RunError(fmt::format("{} of the start is not finite everywhere", name));
  };
  check("phi", start.phi);
  if (scene.has_phases() && !start.fields.contains("psi")) check("psi", {});
  for (const auto& [name, values] : start.fields) check(name.c_str(), values);
  return start;
}
} // namespace

Simulation::Simulation(const Scene& scene, const SurfaceTerms& more)
    : Simulation(scene, start_of(scene), more) {}

StepControl Simulation::control_of(const Scene& scene) {
  return StepControl({scene.numerics.tolerance, scene.grid().spacing, scene.longest_step()});
}

int Simulation::responses_of(const Scene& scene) {
  return scene.area_difference.constraint == Constraint::free && !scene.has_phases() ? 1 : 2;
}

Simulation::Simulation(const Scene& scene, const Start& start, const SurfaceTerms& more)
    : contact_(scene.contact), control_(control_of(scene)), fourier_(scene.grid()),
      vesicle_(scene, checked(start, scene), fourier_, more), gauge_(scene.grid()),
      stepper_(scene.grid(), fourier_, responses_of(scene)), cells_(start.cells) {
  if (vesicle_.drift(0) > hopeless_drift) throw RunError(why_not_kept());
  note(vesicle_.measures(0));
  topology_ = {measures_.components, measures_.genus};
  check(measures_);
  find_narrow_places();
  domains_ = domains();
  note_unresolved();
}

Frame Simulation::frame() const {
  std::vector<double> phi(grid().size());
  nodal_values(grid(), broken_ ? stepper_.before() : vesicle_.phi().coefficients(), phi);
  Frame frame{grid(), time(), std::move(phi), cells_};
  for (const EvolvingField* field : vesicle_.fields())
    frame.fields[field->name()] = field->nodal(broken_);
  return frame;
}

void Simulation::step(double latest) {
  if (!why_not_on_.empty()) throw RunError(why_not_on_);
  vesicle_.keep_apart(time());
  if (vesicle_.set_out(time())) response_dt_ = 0; // there is one more
  for (;;) {
    double then = time() + choose_dt(latest);
    if (then > latest * (1 - 1e-12)) then = latest; // rounding
    const double dt = then - time();
    const std::optional<Failure> failure = try_step(then);
    if (!failure) break;
    take_back(*failure, dt);
  }
  if (time() >= failed_before_) failures_ = 0;
  change_topology_if_needed();
  note_domains();
  note_unresolved();
  recentre_if_needed();
  renormalise_if_needed();
}

/// Why a step cannot be kept; nothing where it is.
std::optional<Simulation::Failure> Simulation::try_step(double then) {
  const SurfaceGeometry& surface = vesicle_.surface();
  const double dt = then - time(), scale = vesicle_.energy_scale(measures_.terms);
  const bool has_history = stepper_.memory().dt > 0;
  gauge_.filter(vesicle_.phi(), vesicle_.band(),
                has_history ? std::min(1.0, last_move() / (noisy_move * grid().spacing)) : 1);
  extend_rates([&](std::size_t i) { return vesicle_.velocity(i); });
  const bool is_balanced = measures_.balance.has_value();
  stepper_.predict(vesicle_.extension(), dt, implicit_symbol(),
                   is_balanced ? history_share_ : SemiImplicit::share_of_history);
  if (steps_ % steps_between_responses == 0 || dt > 1.5 * response_dt_ || 1.5 * dt < response_dt_) {
    extend_rates([&](std::size_t i) { return surface.KM()[i]; });
    stepper_.respond(0, vesicle_.extension());
    if (const int m = second_response()) {
      extend_rates([&](std::size_t i) { return vesicle_.direction(m, i); });
      stepper_.respond(1, vesicle_.extension());
    }
    response_dt_ = dt;
  }
  if (vesicle_.phases()) predict_boundary(dt);
  if (vesicle_.stretch()) step_stretch(dt);
  step_materials(dt);
  holdings_ = vesicle_.holdings();
  apply_constrained(then);
  const Quantities had = quantities(vesicle_.integrals_of_each());
  const Multipliers pulled = vesicle_.multipliers();
  EnergyBalance balance;
  if (is_balanced) balance.dissipated = dissipated(dt);
  error_ = std::max(step_error(), boundary_error());
  last_dt_ = dt;
  broken_ = true;
  const Quantities excess = vesicle_.measure(then);
  if (!(vesicle_.drift(then) < hopeless_drift)) return Failure{why_not_kept(), time()};
  Measures now = vesicle_.measures(then);
  now.dt = dt;
  if (driven_ == 0 && !vesicle_.is_driven(time(), then))
    now.energy_rise = std::max(0.0, (now.energy - measures_.energy) / scale);
  if (*now.energy_rise > largest_rise) return Failure{why_not_risen(now), then};
  if (broke_film(now)) {
    const CriticalPoint* film = narrowest_place().second;
    const std::string message = film_message(film ? film->place : place_of_change());
    go_back();
    throw RunError(message);
  }
  check(now);
  if (is_balanced) {
    balance.work = vesicle_.work_since(had, pulled);
    now.balance = balance;
    correct_lag(balance, measures_.energy - now.energy, scale);
  }
  excess_ = excess_.cols() == excess.cols() ? Quantities(memory * excess_ + excess) : excess;
  steps_++;
  note(now);
  broken_ = false;
  driven_ = 0;
  return {};
}

/// For a shorter step, or not at all.
void Simulation::take_back(const Failure& failure, double dt) {
  const double h = grid().spacing,
               shortest = shortest_step * h * h * h * h / vesicle_.stiffness_of_grid();
  failed_before_ = failures_ == 0 ? failure.until : std::max(failed_before_, failure.until);
  if (++failures_ >= most_failures || dt < shortest) throw RunError(failure.why);
  go_back();
  next_search_ = next_parting_ = steps_; // a neck that is about to part may be what failed
  change_topology_if_needed();
  if (!why_not_on_.empty()) throw RunError(why_not_on_);
}

/// Carries rates at the samples into the box.
template <class Rate>
void Simulation::extend(Rate&& rate) {
  const SurfaceGeometry& surface = vesicle_.surface();
  work_.resize(vesicle_.band().size());
  for (std::size_t i = 0; i < surface.entry().size(); i++) work_[surface.entry()[i]] = rate(i);
  vesicle_.extension().complete(0, work_);
  vesicle_.extension().fill(vesicle_.band(), work_);
}

/// d phi / dt = -v |grad phi| for a velocity v at the samples.
template <class Velocity>
void Simulation::extend_rates(Velocity&& v) {
  extend([&](std::size_t i) { return -v(i) * vesicle_.surface().grad()[i]; });
}

void Simulation::step_stretch(double dt) {
  StretchField& stretch = *vesicle_.stretch();
  const SurfaceGeometry& surface = vesicle_.surface();
  extend([&](std::size_t i) { return stretch.rate(i, surface.KM()[i], vesicle_.velocity(i)); });
  EvolvingField& c = stretch.c().evolving();
  c.stepper().predict(vesicle_.extension(), dt, {0, stretch.law().diffusivity()});
  c.stepper().apply(c.spline(), {}, 0);
  // Smoothed: without, the least c of two domains at mu = 1000 falls to .945, not .977. It is not
  // known why.
  stretch.c().extend(vesicle_.band(), surface, vesicle_.extension(), true);
}

/// What has a value moves with the membrane as extend() lets it; an amount thins or thickens too.
void Simulation::step_materials(double dt) {
  const SurfaceGeometry& surface = vesicle_.surface();
  for (CarriedField& field : vesicle_.materials()) {
    EvolvingField& m = field.evolving();
    if (field.carried() == Carried::amount) {
      extend([&](std::size_t i) { return field.rate(i, surface.KM()[i], vesicle_.velocity(i)); });
      m.stepper().predict(vesicle_.extension(), dt, {0, 0});
      m.stepper().apply(m.spline(), {}, 0);
    } else {
      m.keep();
    }
    field.extend(vesicle_.band(), surface, vesicle_.extension(), false);
  }
}

/// Adds to the step's increment what leads the constraints to their targets to first order: the
/// responses to a tension and to a multiplier of the area difference, and a constant. What the last
/// steps gained beyond first order is expected again. (Constraint forces in the metric of the
/// implicit step: energy then falls as in a gradient flow of that metric. Corrected afterwards,
/// along K_M itself, long tubes began to oscillate.)
void Simulation::apply_constrained(double time) {
  const SurfaceGeometry& surface = vesicle_.surface();
  const Constraints& constraints = vesicle_.constraints();
  const Components& vesicles = vesicle_.components();
  Phases* phases = vesicle_.phases();
  const int second = second_response();
  const Eigen::Index n = vesicles.count();
  std::vector<double> moved = on_membrane(stepper_.increment());
  auto change_by = [&](const std::vector<double>& along) {
    return changes_from(
        vesicle_.moments([&](std::size_t i) { return -along[i] / surface.grad()[i]; }));
  };
  Quantities predicted = change_by(moved);
  if (phases)
    predicted.row(3) += phases->change_of_area(
        on_membrane(phases->evolving().stepper().increment()), surface, vesicles);
  Eigen::MatrixXd effect = Eigen::MatrixXd::Zero(4 * n, 4 * n);
  auto set_effect = [&](int direction, const Quantities& changes) {
    for (Eigen::Index k = 0; k < n; k++)
      effect.block<4, 1>(4 * k, 4 * k + direction) = changes.col(k);
  };
  set_effect(0,
             changes_from(vesicle_.moments([&](std::size_t i) { return -1 / surface.grad()[i]; })));
  set_effect(1, change_by(on_membrane(stepper_.response(0))));
  if (second) set_effect(second, change_by(on_membrane(stepper_.response(1))));
  if (phases) {
    const Eigen::VectorXd lengths = phases->length(surface, vesicles);
    for (Eigen::Index k = 0; k < n; k++)
      effect(4 * k + 3, 4 * k + 3) -= response_dt_ * lengths[k] / phases->drag();
  }
  if (excess_.cols() != n) excess_.setZero(4, n);
  const Eigen::Matrix4Xd factors = constraints.combination(
      effect,
      constraints.target(time) - quantities(vesicle_.integrals_of_each()) - excess_ - predicted,
      vesicle_.integrals_of_each());
  if (!factors.allFinite()) throw RunError("the step is not finite");
  if (n > 1) return apply_to_each(factors);
  const double along[2] = {factors(1), second ? factors(second) : 0};
  stepper_.apply(vesicle_.phi(), along, factors(0));
  if (phases)
    phases->evolving().stepper().apply(phases->psi(), {},
                                       response_dt_ * factors(3) / phases->drag());
}

/// The same factors would move the other vesicles: each has its own rates, which the step smooths
/// where vesicles are near.
void Simulation::apply_to_each(const Eigen::Matrix4Xd& factors) {
  const SurfaceGeometry& surface = vesicle_.surface();
  const Components& vesicles = vesicle_.components();
  const int second = second_response();
  extend([&](std::size_t i) {
    const auto f = factors.col(vesicles.of_sample(i));
    const double v =
        f[1] * surface.KM()[i] + (second ? f[second] * vesicle_.direction(second, i) : 0);
    return f[0] / response_dt_ - v * surface.grad()[i];
  });
  stepper_.apply(vesicle_.phi(), vesicle_.extension(), response_dt_);
  if (!vesicle_.phases()) return;
  Phases& phases = *vesicle_.phases();
  extend([&](std::size_t i) { return factors(3, vesicles.of_sample(i)) / phases.drag(); });
  phases.evolving().stepper().apply(phases.psi(), vesicle_.extension(), response_dt_);
}

/// A field of coefficients at the samples.
std::vector<double> Simulation::on_membrane(std::span<const double> coefficients) const {
  const SurfaceGeometry& surface = vesicle_.surface();
  const ConstPoints p = surface.points();
  SplineView field = vesicle_.phi().view();
  field.coefficients = coefficients.data();
  std::vector<double> values(surface.size());
  parallel_for(surface.size(), 1024, [&](std::size_t begin, std::size_t end) {
    kernels().cubic(field, end - begin, {p.x + begin, p.y + begin, p.z + begin}, &values[begin]);
  });
  return values;
}

/// The multiplier besides the tension along whose response constraints are kept; 0: none.
int Simulation::second_response() const {
  const Constraints& constraints = vesicle_.constraints();
  return constraints.is_held(2) ? 2 : constraints.is_held(3) ? 3 : 0;
}

ImplicitSymbol Simulation::implicit_symbol() const {
  const double tension = vesicle_.greatest_tension() + vesicle_.curvature_tension();
  const double gradient = vesicle_.gradient_stiffness();
  if (!vesicle_.phases()) return {vesicle_.stiffness(), std::max(0.0, tension), gradient};
  const LineForces::Stiffness line = vesicle_.phases()->line_forces().of_membrane();
  return {vesicle_.stiffness() + line.stiffness,
          std::max(0.0, tension) + line.tension +
              vesicle_.phases()->line().tension / vesicle_.constraints().radius(),
          gradient};
}

void Simulation::predict_boundary(double dt) {
  Phases& phases = *vesicle_.phases();
  phases.extend_rates(vesicle_.band(), dt, vesicle_.extension());
  const LineForces::Stiffness line = phases.line_forces().of_boundary();
  phases.evolving().stepper().predict(
      vesicle_.extension(), dt,
      {line.stiffness / phases.drag(), (phases.line().tension + line.tension) / phases.drag()});
}

/// After phi was changed by other means than a step. Returns the area before it was put back.
double Simulation::restart() {
  excess_.setZero(4, 1);
  stepper_.restart();
  for (EvolvingField* field : vesicle_.fields()) field->restart();
  return vesicle_.measure_anew(time());
}

/// To the state before the step that failed, for a shorter one without history.
void Simulation::go_back() {
  std::ranges::copy(stepper_.before(), vesicle_.phi().coefficients().begin());
  for (EvolvingField* field : vesicle_.fields()) field->go_back();
  vesicle_.restore(holdings_);
  broken_ = false;
  restart();
  last_dt_ *= 0.1;
  error_ = 0;
}

double Simulation::choose_dt(double latest) const {
  double dt = last_dt_ == 0
                  ? control_.first(vesicle_.max_force())
                  : control_.next(last_dt_, error_, std::max(speed(), vesicle_.max_line_speed()),
                                  vesicle_.relaxation_time());
  dt = std::min(dt, vesicle_.longest_step(time()));
  if (vesicle_.turns_at(time())) dt = std::min(dt, control_.first(vesicle_.max_speed()));
  const double left = latest - time();
  if (dt >= left * (1 - 1e-9)) return left;
  return dt > 0.5 * left ? 0.5 * left : dt;
}

/// At which steps move the membrane, at most. Of sixth derivatives of phi much is what the grid
/// does not resolve: velocities that the implicit step leaves nothing of. So where there are any,
/// it is the last step that tells.
double Simulation::speed() const {
  const double dt = stepper_.memory().dt;
  if (vesicle_.gradient_stiffness() == 0 || dt == 0) return vesicle_.max_speed();
  return last_move() / dt;
}

/// How far the last step moved the membrane, at most.
double Simulation::last_move() const {
  const SurfaceGeometry& surface = vesicle_.surface();
  const NarrowBand& band = vesicle_.band();
  double furthest = 0;
  for (std::size_t i = 0; i < surface.entry().size(); i++) {
    const int s = surface.entry()[i];
    if (std::abs(band.distance()[s]) < grid().spacing)
      furthest =
          std::max(furthest, std::abs(stepper_.increment()[band.node()[s]]) / surface.grad()[i]);
  }
  return furthest;
}

double Simulation::next_dt() const { return choose_dt(1e300); }

/// int u^2 dA / dt of the last step, u its displacement.
double Simulation::dissipated(double dt) const {
  const SurfaceGeometry& surface = vesicle_.surface();
  const ConstPoints p = surface.points();
  SplineView field = vesicle_.phi().view();
  field.coefficients = stepper_.increment().data();
  constexpr std::size_t samples_per_task = 256;
  return parallel_sum<double>(
      surface.size(), samples_per_task, [&](std::size_t begin, std::size_t end) {
        double change[samples_per_task], sum = 0;
        kernels().values(field, end - begin, {p.x + begin, p.y + begin, p.z + begin}, change);
        for (std::size_t i = begin; i < end; i++) {
          const double u = change[i - begin] / surface.grad()[i];
          sum += surface.weight()[i] * u * u;
        }
        return sum / dt;
      });
}

/// Lets stiff modes keep more of their history where a step dissipated less than the energy lost,
/// and less where it dissipated more.
void Simulation::correct_lag(const EnergyBalance& balance, double lost, double scale) {
  const double all = lost + balance.work,
               excess = (balance.dissipated - all) / std::max(all, least_lost * scale);
  history_share_ =
      std::clamp(history_share_ - std::clamp(share_gain * excess, -most_gained, most_given_up),
                 least_share, 1.0);
}

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

/// The same of psi over the nodes next to the phase boundary.
double Simulation::boundary_error() const {
  if (!vesicle_.phases()) return 0;
  const BoundaryFeet& feet = vesicle_.phases()->feet();
  const NarrowBand& band = vesicle_.band();
  const SemiImplicit& stepper = *vesicle_.phases()->evolving().stepper_if_made();
  const double ratio = stepper.step_ratio(), h = grid().spacing;
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t s = 0; s < band.size(); s++) {
    if (std::abs(band.distance()[s]) > h || !feet[s].exists() || std::abs(feet[s].distance) > 2 * h)
      continue;
    const int node = band.node()[s];
    const double e = stepper.increment()[node] - ratio * stepper.previous_increment()[node];
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

std::string Simulation::why_not_risen(const Measures& risen) const {
  std::pair<std::string_view, double> most{};
  const auto compare = [&](std::string_view phrase, double rise) {
    if (rise > most.second) most = {phrase, rise};
  };
  for (const TermInfo& term : energy_term_table)
    compare(term.phrase, risen.terms.value(term.term) - measures_.terms.value(term.term));
  for (const auto& [name, energy] : risen.terms.others())
    compare(name, energy - measures_.terms.others().at(name));
  return fmt::format("the energy would rise from {:.6g} to {:.6g} in a step, however short, though "
                     "nothing drives the vesicle; most of it is {}. The grid does not resolve what "
                     "happens there; try more grid.nodes",
                     measures_.energy, risen.energy, most.first);
}

/// Throws where the state is none to go on from.
void Simulation::check(const Measures& m) const {
  const SurfaceGeometry& surface = vesicle_.surface();
  for (double value :
       {m.energy, m.int_KM2, m.P, m.sigma, m.K_multiplier, m.area, m.volume, m.max_speed})
    if (!std::isfinite(value)) throw RunError("a measured value is not finite");
  if (!(m.volume > 0 && m.area > 0)) throw RunError("the membrane no longer encloses a volume");
  if (const std::string why = vesicle_.why_not_stiff(); !why.empty()) throw RunError(why);
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
