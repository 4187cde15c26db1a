#include "dynamics/simulation.h"

#include "error.h"
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

// Relative error of what is held: what the start may have against the exact shape (of a sphere
// quadrature gets volume or area right), what needs no correction, what is good enough to be
// recorded, and what makes a step a failure.
constexpr double start_drift = 1e-4, negligible_drift = 5e-7, worst_drift = 5e-6,
                 hopeless_drift = 1e-4;
constexpr int most_projections = 12;
constexpr double longest_displacement = 0.3;
// Spacings; displaced further than that, the membrane needs samples that it did not before. (With
// the area difference held, always: int K_M dA feels to first order that points displaced along
// their normals are no longer the nearest ones.)
constexpr double far_displacement = 0.02;
// Of what steps add to the constraints beyond first order; on a sphere it cannot be made up for.
constexpr double memory = 0.9;

// |grad phi| over its mean; where it varies more the step loses stability.
constexpr double gauge_limit = 1.2;
constexpr int steps_between_renormalisations = 5;
constexpr int steps_between_responses = 4;

// Of the membrane from a side of the box, at which the box follows it.
constexpr double recentre_margin = 3.5;
// Smaller radii of curvature and half-widths of gaps are reported as unresolved.
constexpr double least_radius = 0.85, least_half_gap = 0.8;
constexpr int most_cuts = 16;             // at one time
constexpr int steps_between_attempts = 5; // to part where it would have raised the energy
constexpr double energy_jump = 0.01;      // of the bending energy; more in a step is a failure
constexpr int most_failures = 8;          // of a step, each time ten times shorter
constexpr double restart_step = 0.03;     // after a change of topology; h^4 / kappa

double sphere_radius(double area) { return std::sqrt(area / (4 * std::numbers::pi)); }
} // namespace

Simulation::Simulation(const Scene& scene)
    : bending_{scene.membrane.bending_modulus, scene.membrane.spontaneous_curvature},
      film_{scene.contact.disjoining_pressure, scene.contact.disjoining_range},
      contact_(scene.contact), constraints_(scene),
      control_(
          {scene.numerics.tolerance, scene.grid().spacing, scene.membrane.bending_modulus,
           scene.numerics.max_time_step > 0 ? scene.numerics.max_time_step : scene.end_time / 16}),
      phi_(scene.grid()), fourier_(scene.grid()), band_(scene.grid(), band_half_width),
      extension_(scene.grid()), gauge_(scene.grid()),
      stepper_(scene.grid(), fourier_,
               scene.area_difference.constraint == Constraint::free ? 1 : 2) {
  place_start(scene);
  if (drift(0) > hopeless_drift) throw RunError(why_not_kept());
  measures_ = summarise(0);
  topology_ = {measures_.components, measures_.genus};
  check(measures_);
  find_narrow_places();
  note_unresolved();
}

/// The level set of the scene's start, and what the constraints set out from.
void Simulation::place_start(const Scene& scene) {
  std::vector<double> start;
  if (scene.shape.kind == ShapeKind::frame) {
    Frame frame = read_frame(scene.shape.file);
    if (frame.grid != grid())
      throw RunError(fmt::format(
          "the frame has {} x {} x {} nodes with a spacing of {:.6g}, the scene {} x {} x {} "
          "with {:.6g}; grid.nodes and grid.half_width must be those of the frame",
          frame.grid.nx(), frame.grid.ny(), frame.grid.nz(), frame.grid.spacing, grid().nx(),
          grid().ny(), grid().nz(), grid().spacing));
    start = std::move(frame.phi);
    cells_ = frame.cells;
  } else {
    start = initial_phi(scene.shape, grid(), scene.perturbation);
  }
  std::ranges::copy(start, phi_.coefficients().begin());
  phi_.fit(start, fourier_);
  locate();
  surface_.curvatures(phi_, band_);
  integrals_ = integrate(surface_, bending_, {});
  start_ = quantities(integrals_);
  if (scene.shape.kind != ShapeKind::frame) {
    start_[0] = exact_volume(scene.shape);
    start_[1] = exact_area(scene.shape);
  }
  // Volume and area first: only then is the area difference that of the shape.
  Scene without = scene;
  without.area_difference = {};
  constraints_ = Constraints(without);
  constraints_.begin(start_);
  measure(0);
  if (drift(0) < start_drift) start_ = quantities(integrals_);
  start_[2] = integrals_.int_KM();
  constraints_ = Constraints(scene);
  constraints_.begin(start_);
  measure_forces(0);
}

Frame Simulation::frame() const {
  LevelSet phi = phi_;
  if (broken_) std::ranges::copy(stepper_.before(), phi.coefficients().begin());
  phi.update_nodal();
  return {grid(), time(), {phi.nodal().begin(), phi.nodal().end()}, cells_};
}

// ------------------------------------------------------------------------------------------------
// measuring

/// Brings the membrane onto its constraints at a time and finds everything that is known of it.
/// Second derivatives suffice to measure what it is off by; what is recorded is measured after the
/// correction. Returns the excess before it.
Quantities Simulation::measure(double time) {
  locate();
  surface_.curvatures(phi_, band_);
  integrals_ = integrate(surface_, bending_, {});
  const Quantities excess = quantities(integrals_) - constraints_.target(time);
  lead_to_constraints(time);
  return excess;
}

/// Displaces the membrane by combinations of 1, K_M, K until it has the quantities that are held.
void Simulation::lead_to_constraints(double time) {
  // Near shapes of extreme area difference the least correction takes a long way.
  const double negligible = constraints_.is_held(2) ? worst_drift : negligible_drift;
  if (drift(time) < negligible) return measure_forces(time);
  set_directions();
  const Eigen::Matrix3d effect = effect_of_directions();
  for (int pass = 0; pass == 0 || (pass < most_projections && drift(time) > worst_drift); pass++) {
    displace(constraints_.combination(effect, constraints_.target(time) - quantities(integrals_)));
    measure_forces(time);
  }
}

/// The displacements 1, K_M, K of the held quantities, as phi takes them: what a change of
/// coefficients moves the membrane by is a little smoother than its nodal values. That counts where
/// the three are almost dependent, near shapes of extreme area difference.
void Simulation::set_directions() {
  for (const int m : constraints_.held()) {
    std::vector<double>&nodal = directions_[m].nodal, &moves = directions_[m].moves;
    nodal.resize(band_.size());
    moves.resize(surface_.size());
    auto function = [&](std::size_t i) {
      return m == 0 ? 1 : m == 1 ? surface_.KM()[i] : surface_.K()[i];
    };
    for (std::size_t i = 0; i < surface_.entry().size(); i++)
      nodal[surface_.entry()[i]] = function(i) * surface_.grad()[i];
    extension_.complete(0, nodal);
    for (std::size_t s = 0; s < band_.size(); s++) nodal[s] *= band_.taper()[s];
    if (constraints_.is_held(2))
      evaluate_on_membrane(nodal, moves);
    else
      for (std::size_t i = 0; i < surface_.size(); i++) moves[i] = function(i);
  }
}

/// The displacement by a change of the band's coefficients.
void Simulation::evaluate_on_membrane(std::span<const double> change, std::vector<double>& moves) {
  field_.resize(grid().size(), 0.0);
  for (std::size_t s = 0; s < band_.size(); s++) field_[band_.node()[s]] = change[s];
  SplineView view = phi_.view();
  view.coefficients = field_.data();
  const ConstPoints p = surface_.points();
  parallel_for(surface_.size(), 256, [&](std::size_t begin, std::size_t end) {
    const std::size_t n = end - begin;
    double taylor[10 * 256];
    kernels().taylor(view, n, {p.x + begin, p.y + begin, p.z + begin}, taylor);
    for (std::size_t i = 0; i < n; i++) moves[begin + i] = taylor[i] / surface_.grad()[begin + i];
  });
  for (std::size_t s = 0; s < band_.size(); s++) field_[band_.node()[s]] = 0;
}

Eigen::Matrix3d Simulation::effect_of_directions() const {
  Eigen::Matrix3d effect = Eigen::Matrix3d::Zero();
  for (const int m : constraints_.held()) {
    Eigen::Vector3d moments = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < surface_.size(); i++) {
      const double w = surface_.weight()[i] * directions_[m].moves[i];
      moments += w * Eigen::Vector3d(1, surface_.KM()[i], surface_.K()[i]);
    }
    effect.col(m) = change_from(moments);
  }
  return effect;
}

double Simulation::drift(double time) const {
  return constraints_.drift(quantities(integrals_), time);
}

void Simulation::locate() {
  phi_.update_nodal();
  band_.update(phi_);
  surface_.sample(phi_, band_);
  if (surface_.size() == 0) throw RunError("the membrane has disappeared");
  extension_.prepare(band_, surface_.sampled());
}

/// A combination of the directions, scaled down to the distance up to which it means something.
void Simulation::displace(const Eigen::Vector3d& u) {
  const double longest = longest_displacement * grid().spacing;
  std::vector<double>& moves = work_;
  moves.assign(surface_.size(), 0);
  double greatest = 0;
  for (std::size_t i = 0; i < surface_.size(); i++) {
    for (const int m : constraints_.held()) moves[i] += u[m] * directions_[m].moves[i];
    greatest = std::max(greatest, std::abs(moves[i]));
  }
  const double scale = greatest > longest ? longest / greatest : 1;
  for (std::size_t i = 0; i < surface_.size(); i++) surface_.displace(i, scale * moves[i], band_);
  std::span<double> c = phi_.coefficients();
  for (std::size_t s = 0; s < band_.size(); s++) {
    double change = 0;
    for (const int m : constraints_.held()) change += u[m] * directions_[m].nodal[s];
    c[band_.node()[s]] -= scale * change;
  }
  if (constraints_.is_held(2) || greatest > far_displacement * grid().spacing) {
    locate();
    surface_.curvatures(phi_, band_);
    set_directions();
  }
}

void Simulation::measure_forces(double time) {
  surface_.jets(phi_, band_);
  const double h = grid().spacing, limit = force_limit * bending_.bending_modulus / (h * h * h);
  variation_.resize(surface_.size());
  max_force_ = 0;
  for (std::size_t i = 0; i < surface_.size(); i++) {
    const double F = bending_.variation(surface_.KM()[i], surface_.K()[i], surface_.lap_KM()[i]);
    variation_[i] = std::clamp(F, -limit, limit);
    max_force_ = std::max(max_force_, std::abs(F));
  }
  if (film_.exists()) push_films_apart();
  integrals_ = integrate(surface_, bending_, variation_);
  multipliers_ = constraints_.multipliers(integrals_, constraints_.rate(time));
  max_speed_ = 0;
  for (std::size_t i = 0; i < surface_.size(); i++)
    max_speed_ = std::max(max_speed_, std::abs(velocity(i)));
}

/// Adds the disjoining pressure to the variation.
void Simulation::push_films_apart() {
  film_energy_ = most_film_pressure_ = 0;
  for (std::size_t i = 0; i < surface_.size(); i++) {
    const double thickness = surface_.thickness(i, band_), pressure = film_.pressure(thickness);
    variation_[i] -= pressure;
    most_film_pressure_ = std::max(most_film_pressure_, pressure);
    film_energy_ += surface_.weight()[i] * film_.density(thickness);
  }
}

/// Normal velocity at a sample (Eq. 80).
double Simulation::velocity(std::size_t i) const {
  return -variation_[i] + multipliers_[0] + multipliers_[1] * surface_.KM()[i] +
         multipliers_[2] * surface_.K()[i];
}

Measures Simulation::summarise(double dt) const {
  Measures m;
  const double A = integrals_.area(), V = integrals_.volume, radius = sphere_radius(A),
               pi = std::numbers::pi;
  m.time = measures_.time + dt;
  m.dt = dt;
  m.bending_energy = integrals_.energy;
  m.energy = integrals_.energy + constraints_.potential(quantities(integrals_)) + film_energy_;
  m.int_KM2 = integrals_.int_KM2();
  m.P = multipliers_[0];
  m.sigma = multipliers_[1];
  m.K_multiplier = multipliers_[2];
  m.area = A;
  m.volume = V;
  m.reduced_volume = V / (4. / 3 * pi * radius * radius * radius);
  m.area_difference = -integrals_.int_KM() / (8 * pi * radius);
  m.area_drift = A / start_[1] - 1;
  m.volume_drift = constraints_.is_held(0) ? V / constraints_.target(m.time)[0] - 1 : 0;
  m.max_speed = max_speed_;
  const Topology topology = topology_of(grid(), phi_.nodal());
  m.components = topology.components;
  m.genus = topology.genus;
  return m;
}

std::string Simulation::why_not_kept() const {
  return steps_ == 0 ? "the start shape is thinner than the grid can resolve; try more grid.nodes"
                     : "volume and area can no longer be kept: somewhere the membrane is thinner "
                       "than the grid can resolve; try more grid.nodes";
}

void Simulation::check(const Measures& m) const {
  for (double value :
       {m.energy, m.int_KM2, m.P, m.sigma, m.K_multiplier, m.area, m.volume, m.max_speed})
    if (!std::isfinite(value)) throw RunError("a measured value is not finite");
  if (!(m.volume > 0 && m.area > 0)) throw RunError("the membrane no longer encloses a volume");
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
  double dt =
      last_dt_ == 0 ? control_.first(max_force_) : control_.next(last_dt_, error_, max_speed_);
  dt = std::min({dt, constraints_.longest_step(time()), film_.longest_step(most_film_pressure_)});
  if (constraints_.turns_at(time())) dt = std::min(dt, control_.first(max_speed_));
  const double left = latest - time();
  if (dt >= left * (1 - 1e-9)) return left;
  return dt > 0.5 * left ? 0.5 * left : dt;
}

double Simulation::next_dt() const { return choose_dt(1e300); }

/// d phi / dt = -v |grad phi| for a velocity v at the samples, carried into the box.
template <class Velocity>
void Simulation::extend_rates(Velocity&& v) {
  work_.resize(band_.size());
  for (std::size_t i = 0; i < surface_.entry().size(); i++)
    work_[surface_.entry()[i]] = -v(i) * surface_.grad()[i];
  extension_.complete(0, work_);
  extension_.fill(band_, work_);
}

/// Adds to the step's increment what leads the constraints to their targets to first order: the
/// responses to a tension and to a multiplier of the area difference, and a constant. What the last
/// steps gained beyond first order is expected again. (Constraint forces in the metric of the
/// implicit step: energy then falls as in a gradient flow of that metric. Corrected afterwards,
/// along K_M itself, long tubes began to oscillate.)
void Simulation::apply_constrained(double time) {
  const std::size_t n = surface_.size();
  const ConstPoints p = surface_.points();
  std::vector<double> along[3];
  auto on_membrane = [&](std::span<const double> nodal, std::vector<double>& values) {
    SplineView field = phi_.view();
    field.coefficients = nodal.data();
    values.resize(n);
    parallel_for(n, 1024, [&](std::size_t begin, std::size_t end) {
      kernels().cubic(field, end - begin, {p.x + begin, p.y + begin, p.z + begin}, &values[begin]);
    });
  };
  on_membrane(stepper_.increment(), along[0]);
  on_membrane(stepper_.response(0), along[1]);
  if (constraints_.is_held(2)) on_membrane(stepper_.response(1), along[2]);

  Eigen::Vector3d constant = Eigen::Vector3d::Zero(), moments[3] = {constant, constant, constant};
  for (std::size_t i = 0; i < n; i++) {
    const double w = -surface_.weight()[i] / surface_.grad()[i];
    const Eigen::Vector3d effect{w, w * surface_.KM()[i], w * surface_.K()[i]};
    constant += effect;
    for (int m = 0; m < 3; m++)
      if (!along[m].empty()) moments[m] += along[m][i] * effect;
  }
  Eigen::Matrix3d effect;
  effect << change_from(constant), change_from(moments[1]), change_from(moments[2]);
  const Eigen::Vector3d factors =
      constraints_.combination(effect, constraints_.target(time) - quantities(integrals_) -
                                           excess_ - change_from(moments[0]));
  if (!factors.allFinite()) throw RunError("the step is not finite");
  stepper_.apply(phi_, std::span(factors.data() + 1, 2), factors[0]);
}

void Simulation::step(double latest) {
  if (!why_not_on_.empty()) throw RunError(why_not_on_);
  if (constraints_.set_out(time(), quantities(integrals_))) {
    measure_forces(time());
    response_dt_ = 0; // there is one more
  }
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
  const double C = bending_.spontaneous_curvature, kappa = bending_.bending_modulus;
  double then = time() + dt;
  if (then > latest * (1 - 1e-12)) then = latest; // rounding
  gauge_.filter(phi_, band_);
  extend_rates([&](std::size_t i) { return velocity(i); });
  stepper_.predict(extension_, dt, {kappa, std::max(0.0, multipliers_[1] + 0.5 * kappa * C * C)});
  if (steps_ % steps_between_responses == 0 || dt > 1.5 * response_dt_ || 1.5 * dt < response_dt_) {
    extend_rates([&](std::size_t i) { return surface_.KM()[i]; });
    stepper_.respond(0, extension_);
    if (constraints_.is_held(2)) {
      extend_rates([&](std::size_t i) { return surface_.K()[i]; });
      stepper_.respond(1, extension_);
    }
    response_dt_ = dt;
  }
  apply_constrained(then);
  error_ = step_error();
  last_dt_ = dt;
  broken_ = true;
  const Quantities excess = measure(then);
  if (!(drift(then) < hopeless_drift)) return false;
  Measures now = summarise(dt);
  now.time = then;
  const bool driven = constraints_.rate(then) != Quantities::Zero() ||
                      constraints_.rate(time()) != Quantities::Zero();
  if (!driven && now.energy - measures_.energy > energy_jump * measures_.bending_energy)
    return false;
  check(now);
  excess_ = memory * excess_ + excess;
  steps_++;
  measures_ = now;
  broken_ = false;
  return true;
}

/// To the state before the step that failed, for a shorter one without history.
void Simulation::go_back() {
  std::ranges::copy(stepper_.before(), phi_.coefficients().begin());
  broken_ = false;
  measure_anew();
  last_dt_ *= 0.1;
  error_ = 0;
}

/// 2 rms |c_new - ratio c_old| / (|grad phi| h) over the nodes next to the membrane.
double Simulation::step_error() const {
  const double ratio = stepper_.step_ratio(), h = grid().spacing;
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < surface_.entry().size(); i++) {
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

/// |grad phi| at the nearest points of band entries; 0 where it is not known.
std::span<const double> Simulation::grad_of_entries() {
  grad_.assign(band_.size(), 0);
  for (std::size_t i = 0; i < surface_.entry().size(); i++)
    grad_[surface_.entry()[i]] = surface_.grad()[i];
  return grad_;
}

void Simulation::renormalise_if_needed() {
  const GaugeRange range = gauge_range(band_, grad_of_entries());
  if (std::max(range.greatest, 1 / range.least) < gauge_limit) return;
  if (steps_ - renormalised_ < steps_between_renormalisations) return;
  extension_.complete(range.mean, grad_);
  stepper_.rescale(gauge_.renormalise(phi_, band_, grad_, extension_, fourier_));
  renormalised_ = steps_;
  measure(time());
}

// ------------------------------------------------------------------------------------------------
// events

Vec3 Simulation::in_space(Vec3 place) const {
  for (int d = 0; d < 3; d++) place[d] += cells_[d] * grid().spacing;
  return place;
}

void Simulation::note(Event event) {
  event.time = time();
  event.place = in_space(event.place);
  events_.push_back(event);
}

/// Says once of each kind that something has become finer than the grid.
void Simulation::note_unresolved() {
  auto noted = [&](Event::Kind kind) {
    return std::ranges::any_of(events_, [&](const Event& e) { return e.kind == kind; });
  };
  if (!noted(Event::Kind::sharp)) {
    std::size_t worst = 0;
    double sharpest = 0;
    for (std::size_t i = 0; i < surface_.size(); i++)
      if (surface_.weight()[i] > 0 && surface_.sharpest(i) > sharpest)
        sharpest = surface_.sharpest(worst = i);
    if (sharpest * least_radius * grid().spacing > 1) {
      Event e = event_now();
      e.kind = Event::Kind::sharp;
      e.place = surface_.point(worst);
      e.size = 1 / sharpest;
      note(e);
    }
  }
  const double least = least_half_gap * grid().spacing;
  for (auto [kind, places] :
       {std::pair{Event::Kind::thin_inside, &inside_}, {Event::Kind::thin_outside, &outside_}}) {
    if (noted(kind) || places->empty() || places->front().radius > least) continue;
    Event e = event_now();
    e.kind = kind;
    e.place = places->front().place;
    e.size = places->front().radius;
    note(e);
  }
}

/// The critical points near the membrane, on either side, the nearest first.
void Simulation::find_narrow_places() {
  const double h = grid().spacing;
  const ClosingRule rule{bending_.bending_modulus, contact_.rupture_thickness};
  const std::span<const double> grad = grad_of_entries();
  inside_ = critical_points(phi_, band_, grad, rule.reach(h), true);
  outside_ = critical_points(phi_, band_, grad, rule.reach(h), false);
}

/// Those inside where the membrane is closing in and the grid can no longer resolve it.
std::optional<Closing> Simulation::closing_place() const {
  const double h = grid().spacing;
  const ClosingRule rule{bending_.bending_modulus, contact_.rupture_thickness};
  for (const CriticalPoint& q : inside_) {
    double speed = 0, grad = 0;
    int count = 0;
    for (const int s : q.around) {
      const auto at = std::ranges::lower_bound(surface_.entry(), s);
      if (at == surface_.entry().end() || *at != s) continue;
      const std::size_t i = std::size_t(at - surface_.entry().begin());
      speed -= velocity(i);
      grad += surface_.grad()[i];
      count++;
    }
    Event::Kind kind{};
    if (count > 0 && rule.parts(q, speed / count, h, kind)) return Closing{kind, q, grad / count};
  }
  return {};
}

/// Notes what parted or met by itself, and parts the inside where it is about to part and that
/// lowers the energy.
void Simulation::change_topology_if_needed() {
  if (topology_ != Topology{measures_.components, measures_.genus}) note_spontaneous_change();
  find_narrow_places();
  if (steps_ < next_parting_) return;
  for (int cuts = 0; cuts < most_cuts; cuts++) {
    const std::optional<Closing> place = closing_place();
    if (!place) return;
    if (!contact_.topology_changes) {
      why_not_on_ = fmt::format("the topology is about to change at {}, which "
                                "contact.topology_changes forbids",
                                place_text(place->at.place));
      return;
    }
    const bool parted = part_at(*place);
    if (!parted) next_parting_ = steps_ + steps_between_attempts;
    if (!parted || place->kind == Event::Kind::rupture) return;
    find_narrow_places();
  }
}

/// A change that the last step made. Necks and gaps may close by themselves; a film that does is
/// beyond the grid, and what is left of it means nothing.
void Simulation::note_spontaneous_change() {
  Event event = event_now();
  event.components_before = topology_.components;
  event.genus_before = topology_.genus;
  topology_ = {measures_.components, measures_.genus};
  const bool gap =
      !outside_.empty() && (inside_.empty() || outside_.front().radius < inside_.front().radius);
  const std::vector<CriticalPoint>& places = gap ? outside_ : inside_;
  if (!places.empty()) {
    event.place = places.front().place;
    event.size = places.front().radius;
  }
  const bool film = !gap && event.genus_after > event.genus_before;
  event.kind = gap                                                ? Event::Kind::fusion
               : film                                             ? Event::Kind::rupture
               : event.components_after > event.components_before ? Event::Kind::fission
                                                                  : Event::Kind::vanished;
  note(event);
  if (film) why_not_on_ = film_message(event.place);
}

std::string Simulation::place_text(const Vec3& place) const {
  const Vec3 at = in_space(place);
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", at[0], at[1], at[2]);
}

std::string Simulation::film_message(const Vec3& place) const {
  return fmt::format("a film of inner fluid at {} has become thinner than the grid resolves; try "
                     "more grid.nodes, or keep films apart with contact.disjoining_pressure",
                     place_text(place));
}

/// False, and nothing is changed, where the energy would rise. A neck too thin for the grid parts
/// all the same; a film that thin is the end of the run.
bool Simulation::part_at(const Closing& place) {
  Event event = event_now();
  event.kind = place.kind;
  event.place = place.at.place;
  event.size = place.at.radius;
  const Array<double> whole(phi_.coefficients().begin(), phi_.coefficients().end());
  part(phi_, place);
  event.area_cut = measure_anew();
  Measures parted = summarise(0);
  const bool film = place.kind == Event::Kind::rupture;
  const bool hopeless =
      event.size <
      (film ? ClosingRule::hopeless_film : ClosingRule::hopeless_neck) * grid().spacing;
  if (!(drift(time()) < hopeless_drift) ||
      (parted.energy > measures_.energy && (film || !hopeless))) {
    if (film && hopeless) why_not_on_ = film_message(event.place);
    std::ranges::copy(whole, phi_.coefficients().begin());
    measure_anew();
    return false;
  }
  const double h = grid().spacing;
  last_dt_ = std::min(last_dt_, restart_step * h * h * h * h / bending_.bending_modulus);
  parted.dt = measures_.dt;
  check(parted);
  measures_ = parted;
  event.components_after = measures_.components;
  event.genus_after = measures_.genus;
  event.energy_after = measures_.energy;
  topology_ = {measures_.components, measures_.genus};
  note(event);
  return true;
}

/// After phi was changed by other means than a step. Returns the area before it was put back.
double Simulation::measure_anew() {
  band_.clear();
  locate();
  locate(); // some nodes of a new band find the right sheet only now
  surface_.curvatures(phi_, band_);
  const double area = integrate(surface_, bending_, {}).area();
  excess_.setZero();
  measure(time());
  stepper_.restart();
  return area;
}

/// With what there is now, before and after.
Event Simulation::event_now() const {
  Event e;
  e.components_before = e.components_after = measures_.components;
  e.genus_before = e.genus_after = measures_.genus;
  e.area_before = e.area_cut = measures_.area;
  e.energy_before = e.energy_after = measures_.energy;
  return e;
}

/// Moves the box by whole cells when the membrane comes near one of its sides and has room on the
/// other.
void Simulation::recentre_if_needed() {
  const double h = grid().spacing;
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (std::size_t i = 0; i < surface_.size(); i++) {
    const Vec3 p = surface_.point(i);
    for (int d = 0; d < 3; d++) {
      low[d] = std::min(low[d], p[d]);
      high[d] = std::max(high[d], p[d]);
    }
  }
  std::array<int, 3> cells{};
  bool near = false;
  for (int d = 0; d < 3; d++) {
    const double side = 0.5 * grid().length(d);
    near = near || std::min(low[d] + side, side - high[d]) < recentre_margin * h;
    cells[d] = int(std::lround(0.5 * (low[d] + high[d]) / h));
  }
  if (!near || cells == std::array<int, 3>{}) return;
  move_box(cells);
  Event event = event_now();
  event.kind = Event::Kind::recentred;
  event.cells = cells;
  note(event);
}

void Simulation::move_box(const std::array<int, 3>& cells) {
  shift(grid(), cells, phi_.coefficients());
  stepper_.shift(cells);
  for (int d = 0; d < 3; d++) cells_[d] += cells[d];
  band_.clear();
  measure(time());
}

} // namespace lamella
