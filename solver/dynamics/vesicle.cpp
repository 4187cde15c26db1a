#include "dynamics/vesicle.h"

#include "dynamics/event.h"
#include "error.h"
#include "expression/formula.h"
#include "levelset/topology.h"
#include "parallel.h"
#include "scene/densities.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace lamella {

namespace {
// Lengths in grid spacings. The band: the spline's reach and a little more.
constexpr double band_half_width = 4.2;
// Largest |F| in kappa / h^3: more is an unresolved tip.
constexpr double force_limit = 1;

// Relative error of what is held: what the start may have against the exact shape (of a sphere
// quadrature gets volume or area right), what needs no correction, and what is good enough to be
// recorded.
constexpr double start_drift = 1e-4, negligible_drift = 5e-7, worst_drift = 5e-6;
constexpr int most_corrections = 12;
constexpr double dent_loss = 2e-4; // of the volume of a sphere
// Of the energy of a start with phases, from one measurement to the next.
constexpr double settled_energy = 1e-3;
constexpr int most_settlings = 10;
constexpr double longest_displacement = 0.3;
// Spacings; displaced further than that, the membrane needs samples that it did not before. (Where
// the constraints are delicate, always: curvatures feel to first order that points displaced along
// their normals are no longer the nearest ones.)
constexpr double far_displacement = 0.02;

bool keeps_apart(const Scene& scene) {
  return scene.area.of == Of::each || scene.volume.of == Of::each;
}

/// Of what each vesicle has a number of its own.
double mean(const Eigen::MatrixXd& number, const Eigen::MatrixXd& weight) {
  if (number.size() == 1) return number(0);
  const double sum = weight.sum();
  return sum == 0 ? 0 : number.cwiseProduct(weight).sum() / sum;
}

Vec3 moved(Vec3 place, const std::array<int, 3>& cells, double spacing) {
  for (int d = 0; d < 3; d++) place[d] += cells[d] * spacing;
  return place;
}

double sphere_radius(double area) { return std::sqrt(area / (4 * std::numbers::pi)); }
} // namespace

/// Without a membrane yet.
Vesicle::Vesicle(const Scene& scene, Fourier& fourier, const SurfaceTerms& more)
    : fourier_(fourier), ld_(scene.has_phases() ? scene.ld : scene.membrane),
      lo_(scene.has_phases() ? scene.lo : scene.membrane), more_(more),
      energy_(scene.membrane, scene.parameters, scene.fields),
      film_{scene.contact.disjoining_pressure, scene.contact.disjoining_range}, constraints_(scene),
      phi_(scene.grid()), band_(scene.grid(), band_half_width), extension_(scene.grid()),
      surface_(scene.has_phases() ? QuadratureKernel::symmetric() : QuadratureKernel::outside()),
      components_(scene.grid(), keeps_apart(scene)) {
  set_energy(energy_);
}

void Vesicle::set_energy(SurfaceEnergy of_scene) {
  energy_ = std::move(of_scene);
  for (const auto& term : more_) energy_.add(term);
  if (energy_.needs() == Derivatives::sixth && !laplacian_) laplacian_.emplace(grid(), fourier_);
}

Vesicle::Vesicle(const Scene& scene, const Start& start, Fourier& fourier, const SurfaceTerms& more)
    : Vesicle(scene, fourier, more) {
  std::ranges::copy(start.phi, phi_.coefficients().begin());
  phi_.fit(start.phi, fourier);
  if (scene.has_phases()) set_phases(scene, start.fields.at("psi"), fourier);
  if (scene.stretch.modulus > 0) {
    stretch_.emplace(scene.stretch.modulus, scene.grid(), fourier);
    if (const auto c = start.fields.find("c"); c != start.fields.end())
      stretch_->c().evolving().fit(c->second, 8);
  }
  locate();
  components_.settle();
  surface_.curvatures(phi_, band_);
  start_materials(scene, start, fourier);
  integrate_all(false);
  Quantities begin = quantities(of_each_);
  if (start.exact && begin.cols() == 1) {
    begin(0) = start.exact->volume;
    begin(1) = start.exact->area;
  }
  if (phases_ && scene.volume.constraint == Constraint::ramped) begin.row(0) *= 1 - leave_sphere();
  // Volume and area first: only then is the area difference that of the shape.
  Scene without = scene;
  without.area_difference = {};
  constraints_ = Constraints(without);
  constraints_.begin(begin);
  set_lengths(scene);
  measure(0);
  if (drift(0) > worst_drift && drift(0) < start_drift) begin = quantities(of_each_); // a sphere
  begin.row(2) = quantities(of_each_).row(2);
  constraints_ = Constraints(scene);
  constraints_.begin(begin);
  set_lengths(scene);
  const Quantities corrected = quantities(of_each_);
  measure_forces(0);
  if (phases_) {
    set_quantities(corrected);
    settle_boundaries();
  }
}

/// The psi of a start need not be a distance; each measurement brings it nearer to one, and only
/// with one do the strips along the boundaries have the energy that they have in a run.
void Vesicle::settle_boundaries() {
  double before = energies().sum();
  for (int pass = 0; pass < most_settlings; pass++) {
    measure(0);
    const EnergyTerms terms = energies();
    const double now = terms.sum();
    if (std::abs(now - before) < settled_energy * energy_scale(terms)) return;
    before = now;
  }
}

Vesicle::State Vesicle::state() const {
  State state = origin_;
  state.constraints = constraints_.state();
  state.constraints.share = origin_.constraints.share;
  state.constraints.group = origin_.constraints.group;
  const auto add = [&](const CarriedField& field) {
    const std::span<const double> c = field.spline().coefficients();
    state.fields[field.evolving().name()] = {{c.begin(), c.end()}, field.amount()};
  };
  if (stretch_) add(stretch_->c());
  for (const CarriedField& field : materials_) add(field);
  return state;
}

Vesicle::Vesicle(const Scene& scene, const State& state, double time, Fourier& fourier,
                 const SurfaceTerms& more)
    : Vesicle(scene, fourier, more) {
  std::ranges::copy(state.phi, phi_.coefficients().begin());
  if (scene.has_phases()) {
    const Array<double>& psi = state.fields.at("psi").coefficients;
    set_phases(scene, psi, fourier);
    phases_->evolving().restore(psi);
    phases_->held().restore(state.held);
    phases_->set_fade(state.fade);
  }
  if (scene.stretch.modulus > 0) {
    const State::Field& c = state.fields.at("c");
    stretch_.emplace(scene.stretch.modulus, scene.grid(), fourier);
    stretch_->c().restore(c.coefficients, c.amount);
  }
  for (const MaterialField& field : scene.fields) {
    const State::Field& from = state.fields.at(field.name);
    materials_.emplace_back(field.name, field.carried, scene.grid(), fourier);
    materials_.back().restore(from.coefficients, from.amount);
  }
  band_.restore(state.band);
  restore({state.vesicle_of_node, state.constraints});
  set_lengths(scene);
  measure(time);
}

void Vesicle::restore(const Holdings& holdings) {
  components_.restore(holdings.vesicle_of_node);
  constraints_.restore(holdings.constraints);
}

void Vesicle::shift(const std::array<int, 3>& cells) {
  lamella::shift(grid(), cells, phi_.coefficients());
  for (EvolvingField* field : fields()) field->shift(cells);
  components_.shift(cells);
}

void Vesicle::set_phases(const Scene& scene, std::span<const double> psi, Fourier& fourier) {
  phases_.emplace(scene, psi, fourier);
  set_energy(phases_->surface_energy(0));
  energy_is_curved_ = phases_->is_curved(0);
}

/// Band entries have their nearest points by now: there formulas are taken.
void Vesicle::start_materials(const Scene& scene, const Start& start, Fourier& fourier) {
  for (const MaterialField& field : scene.fields) {
    CarriedField& material =
        materials_.emplace_back(field.name, field.carried, scene.grid(), fourier);
    if (const auto from = start.fields.find(field.name); from != start.fields.end()) {
      material.evolving().fit(from->second, 60);
      continue;
    }
    const Tape tape = read_formula(field.start, names_in_space(scene.parameters)).tape;
    std::vector<double> registers;
    const auto value = [&](const Vec3& place) {
      double result = 0;
      const Vec3 in_space = moved(place, start.cells, grid().spacing);
      tape.evaluate<double>(in_space, {&result, 1}, registers);
      if (!std::isfinite(result))
        throw RunError(fmt::format("the field {} is not finite at ({:.4g}, {:.4g}, {:.4g}) on the "
                                   "start shape; its start must be a number everywhere there",
                                   field.name, in_space[0], in_space[1], in_space[2]));
      return result;
    };
    material.start(value, band_, extension_);
  }
}

/// Those that are left to the size of the vesicle.
void Vesicle::set_lengths(const Scene& scene) {
  constexpr double range = 0.04;
  const double radius = constraints_.radius();
  if (scene.contact.disjoining_range == 0) film_.range = range * radius;
  if (phases_) phases_->set_drag(scene.line.drag > 0 ? scene.line.drag : radius);
}

void Vesicle::note_origin() {
  const std::span<const double> phi = phi_.coefficients();
  origin_.phi.assign(phi.begin(), phi.end());
  band_.store(origin_.band);
  origin_.vesicle_of_node = components_.settled();
  origin_.constraints = constraints_.state();
  if (!phases_) return;
  const std::span<const double> psi = phases_->psi().coefficients();
  origin_.fields["psi"].coefficients.assign(psi.begin(), psi.end());
  origin_.held = phases_->held().parts();
  origin_.fade = phases_->fade();
}

/// A sphere cannot lose volume at a given area, and nothing in its curvature says where to: the
/// first bit of the way is a dent along the phase boundary, where the line tension would take it.
/// Returns the share of the volume to be lost there, 0 where the membrane is no sphere.
double Vesicle::leave_sphere() {
  const double radius = sphere_radius(integrals_.area());
  auto lost = [&] { // 1 - reduced volume
    const double r = sphere_radius(integrals_.area());
    return 1 - integrals_.volume / (4. / 3 * std::numbers::pi * r * r * r);
  };
  if (lost() > dent_loss) return 0;
  auto dent = [&](double depth) {
    std::span<double> c = phi_.coefficients();
    for (std::size_t s = 0; s < band_.size(); s++)
      c[band_.node()[s]] += depth * band_.taper()[s] * phases_->near_boundary(band_.node()[s]);
    locate();
    surface_.curvatures(phi_, band_);
    integrate_all(false);
  };
  const double first = 0.01 * radius;
  dent(first);
  dent(first * (std::sqrt(dent_loss / std::max(lost(), 0.01 * dent_loss)) - 1));
  return dent_loss;
}

/// Brings the membrane onto its constraints at a time and finds everything that is known of it.
/// Second derivatives suffice to measure what it is off by; what is recorded is measured after the
/// correction. Returns the excess before it.
Quantities Vesicle::measure(double time) {
  note_origin();
  locate();
  surface_.curvatures(phi_, band_);
  integrate_all(false);
  if (!components_.succession().is_unchanged()) constraints_.hand_on(components_.succession());
  components_.settle();
  const Quantities excess = quantities(of_each_) - constraints_.target(time);
  lead_to_constraints(time);
  return excess;
}

double Vesicle::measure_anew(double time) {
  band_.clear();
  locate();
  locate(); // some nodes of a new band find the right sheet only now
  surface_.curvatures(phi_, band_);
  const double area = integrate(surface_, {}).area();
  measure(time);
  return area;
}

void Vesicle::locate() {
  locate_membrane();
  components_.follow(phi_.nodal());
  components_.find_entries(band_);
  if (phases_) phases_->locate(phi_, band_, components_);
}

void Vesicle::locate_membrane() {
  phi_.update_nodal();
  band_.update(phi_);
  surface_.sample(phi_, band_);
  if (surface_.size() == 0) throw RunError("the membrane has disappeared");
  extension_.prepare(band_, surface_.sampled());
}

double Vesicle::drift(double time) const { return constraints_.drift(quantities(of_each_), time); }

/// Displaces the membrane by combinations of 1, K_M, K, q K_M until it has the quantities that are
/// held.
void Vesicle::lead_to_constraints(double time) {
  delicate_ = constraints_.is_delicate(of_each_);
  const double negligible = delicate_ ? worst_drift : negligible_drift; // it would go a long way
  if (drift(time) < negligible) return measure_forces(time);
  set_directions();
  const Eigen::MatrixXd effect = effect_of_directions();
  for (int pass = 0; pass == 0 || (pass < most_corrections && drift(time) > worst_drift); pass++) {
    const Quantities now = quantities(of_each_);
    const Eigen::Matrix4Xd u =
        constraints_.combination(effect, constraints_.target(time) - now, of_each_);
    const bool anew = displace(u);
    measure_forces(time);
    if (phases_ && !anew)
      return set_quantities(now + (effect * u.reshaped()).reshaped(4, now.cols()));
  }
}

/// What a small displacement leads to is known better than quadrature tells from points that are no
/// longer the nearest ones.
void Vesicle::set_quantities(const Quantities& q) {
  auto set = [](SurfaceIntegrals& of, const Eigen::Vector4d& to) {
    of.volume = to[0];
    of.gram(0, 0) = to[1];
    of.gram(0, 1) = of.gram(1, 0) = to[2];
    of.area_Ld = to[3];
  };
  for (Eigen::Index k = 0; k < q.cols(); k++) set(of_each_[std::size_t(k)], q.col(k));
  set(integrals_, q.rowwise().sum());
}

double Vesicle::direction(int m, std::size_t i) const {
  const double KM = surface_.KM()[i];
  return m == 0 ? 1 : m == 1 ? KM : m == 2 ? surface_.K()[i] : phases_->share()[i] * KM;
}

/// The displacements 1, K_M, K, q K_M of the held quantities; where the constraints are delicate,
/// as phi takes them: what a change of coefficients moves the membrane by is a little smoother than
/// its nodal values.
void Vesicle::set_directions() {
  for (const int m : constraints_.held()) {
    std::vector<double>&nodal = directions_[m].nodal, &moves = directions_[m].moves;
    nodal.resize(band_.size());
    moves.resize(surface_.size());
    for (std::size_t i = 0; i < surface_.entry().size(); i++)
      nodal[surface_.entry()[i]] = direction(m, i) * surface_.grad()[i];
    extension_.complete(0, nodal);
    for (std::size_t s = 0; s < band_.size(); s++) nodal[s] *= band_.taper()[s];
    if (delicate_ || phases_)
      evaluate_on_membrane(nodal, moves);
    else
      for (std::size_t i = 0; i < surface_.size(); i++) moves[i] = direction(m, i);
  }
}

/// The displacement by a change of the band's coefficients.
void Vesicle::evaluate_on_membrane(std::span<const double> change, std::vector<double>& moves) {
  field_.resize(grid().size(), 0.0);
  for (std::size_t s = 0; s < band_.size(); s++) field_[band_.node()[s]] = change[s];
  SplineView view = phi_.view();
  view.coefficients = field_.data();
  const ConstPoints p = surface_.points();
  parallel_for(surface_.size(), 256, [&](std::size_t begin, std::size_t end) {
    const std::size_t n = end - begin;
    kernels().values(view, n, {p.x + begin, p.y + begin, p.z + begin}, &moves[begin]);
    for (std::size_t i = begin; i < end; i++) moves[i] /= surface_.grad()[i];
  });
  for (std::size_t s = 0; s < band_.size(); s++) field_[band_.node()[s]] = 0;
}

Eigen::MatrixXd Vesicle::effect_of_directions() const {
  const Eigen::Index n = components_.count();
  Eigen::MatrixXd effect = Eigen::MatrixXd::Zero(4 * n, 4 * n);
  for (const int m : constraints_.held()) {
    const std::vector<double>& moves = directions_[m].moves;
    const Quantities changes = changes_from(moments([&](std::size_t i) { return moves[i]; }));
    for (Eigen::Index k = 0; k < n; k++) effect.block<4, 1>(4 * k, 4 * k + m) = changes.col(k);
  }
  if (phases_)
    for (Eigen::Index k = 0; k < n; k++)
      effect(4 * k + with_boundary, 4 * k + with_boundary) -= lengths_[k] / phases_->drag();
  return effect;
}

/// A combination of the directions, scaled down to the distance up to which it means something.
/// True where it was so far that all is found anew.
bool Vesicle::displace(const Eigen::Matrix4Xd& u) {
  const double longest = longest_displacement * grid().spacing;
  std::vector<double>& moves = work_;
  moves.assign(surface_.size(), 0);
  double greatest = 0;
  for (std::size_t i = 0; i < surface_.size(); i++) {
    const int k = components_.of_sample(i);
    for (const int m : constraints_.held()) moves[i] += u(m, k) * directions_[m].moves[i];
    greatest = std::max(greatest, std::abs(moves[i]));
  }
  const Eigen::VectorXd along =
      phases_ ? Eigen::VectorXd(u.row(with_boundary) / phases_->drag()) : Eigen::VectorXd();
  for (const double x : along) greatest = std::max(greatest, std::abs(x));
  const double scale = greatest > longest ? longest / greatest : 1;
  for (std::size_t i = 0; i < surface_.size(); i++) surface_.displace(i, scale * moves[i], band_);
  std::span<double> c = phi_.coefficients();
  for (std::size_t s = 0; s < band_.size(); s++) {
    double change = 0;
    const int k = components_.of_entry(s);
    for (const int m : constraints_.held()) change += u(m, k) * directions_[m].nodal[s];
    c[band_.node()[s]] -= scale * change;
  }
  if (phases_) move_boundaries(scale * along);
  if (!delicate_ && greatest < far_displacement * grid().spacing) return false;
  locate_membrane();
  components_.find_entries(band_);
  surface_.curvatures(phi_, band_);
  components_.find_samples(surface_);
  if (phases_) {
    phases_->follow(phi_, band_);
    phases_->sample(band_, surface_, components_);
  }
  set_directions();
  return true;
}

/// By so much along n on each vesicle.
void Vesicle::move_boundaries(const Eigen::VectorXd& along) {
  const std::span<double> psi = phases_->psi().coefficients();
  if (along.size() == 1)
    for (double& p : psi) p += along[0];
  else
    for (std::size_t s = 0; s < band_.size(); s++)
      psi[band_.node()[s]] += band_.taper()[s] * along[components_.of_entry(s)];
}

/// `with_forces`: the variation is known.
void Vesicle::integrate_all(bool with_forces) {
  // The strips along phase boundaries are not the closed surfaces of one stiffness that the
  // integrals by parts are of.
  const Variation variation =
      with_forces ? Variation{variation_, phases_ ? 0 : stiffness()} : Variation{};
  components_.find_samples(surface_);
  if (phases_ && !with_forces) phases_->sample(band_, surface_, components_);
  of_each_.clear();
  integrals_ = {};
  lengths_.setZero(components_.count());
  for (int k = 0; k < components_.count(); k++) {
    const Samples samples = components_.samples(k);
    SurfaceIntegrals& of = of_each_.emplace_back(integrate(surface_, variation, samples));
    if (phases_) {
      const PhaseIntegrals p = phases_->integrate(surface_, samples);
      of.area_Ld = p.area_Ld;
      of.gram.row(with_boundary) = p.gram.transpose();
      of.gram.col(with_boundary) = p.gram;
      lengths_[k] = p.length;
    }
    integrals_ += of;
  }
}

void Vesicle::measure_forces(double time) {
  if (phases_ && energy_is_curved_ != phases_->is_curved(time)) {
    set_energy(phases_->surface_energy(time));
    energy_is_curved_ = !energy_is_curved_;
  }
  surface_.jets(phi_, band_,
                phases_ ? std::max(Derivatives::gradient, energy_.needs()) : energy_.needs());
  if (energy_.needs() == Derivatives::sixth) {
    laplacian_->find(phi_, band_, surface_, extension_);
    surface_.differentiate(laplacian_->spline());
  }
  for (CarriedField& field : materials_) field.sample(surface_);
  const auto fields = jets_of(materials_);
  variation_.resize(surface_.size());
  if (phases_)
    phases_->find_forces(phi_, surface_, energy_, variation_, materials_);
  else
    energy_.find_forces(surface_, {}, {}, variation_, fields);
  stiffness_ =
      energy_.stiffness(surface_, phases_ ? phases_->is_Ld() : std::span<const char>(), fields);
  if (stretch_) {
    stretch_->c().sample(surface_);
    stretch_->add_variation(surface_, variation_);
    if (phases_) phases_->add_flow(*stretch_);
  }
  const double h = grid().spacing, limit = force_limit * stiffness_of_grid() / (h * h * h) +
                                           (phases_ ? phases_->line_forces().greatest() : 0);
  max_force_ = 0;
  for (double& F : variation_) {
    max_force_ = std::max(max_force_, std::abs(F));
    F = std::clamp(F, -limit, limit);
  }
  if (film_.exists()) push_films_apart();
  integrate_all(true);
  find_velocities(time);
}

void Vesicle::find_velocities(double time) {
  find_multipliers(time);
  max_speed_ = 0;
  for (std::size_t i = 0; i < surface_.size(); i++)
    max_speed_ = std::max(max_speed_, std::abs(velocity(i)));
}

/// With phases a tension more for each area that is held; what the phases differ by, they do so in
/// the mean.
void Vesicle::find_multipliers(double time) {
  const Quantities rate = constraints_.rate(time);
  const int vesicles = components_.count();
  const Eigen::Index surface = 3 * vesicles, n = phases_ ? Eigen::Index(phases_->held().size()) : 0;
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(surface + n, surface + n);
  Eigen::VectorXd variation(surface + n);
  for (int k = 0; k < vesicles; k++) {
    gram.block<3, 3>(3 * k, 3 * k) = of_each_[k].gram.topLeftCorner<3, 3>();
    variation.segment<3>(3 * k) = of_each_[k].variation;
  }
  HeldAreas::Integrals held;
  if (phases_) {
    held = phases_->integrate_held(surface_, variation_, components_);
    gram.bottomLeftCorner(n, surface) = held.with_surface;
    gram.topRightCorner(surface, n) = held.with_surface.transpose();
    gram.bottomRightCorner(n, n) = held.gram;
    variation.tail(n) = held.variation;
  }
  const Eigen::VectorXd m = constraints_.multipliers(gram, variation, rate);
  multipliers_ = Multipliers::Zero(4, vesicles);
  multipliers_.topRows<3>() = m.head(surface).reshaped(3, vesicles);
  if (!phases_) return;
  phases_->held().set_tensions(m.tail(n), held, phases_->share(), integrals_.area());
  multipliers_.row(3).setConstant(phases_->held().mean_Ld() - phases_->held().mean_Lo());
}

/// Adds the disjoining pressure to the variation.
void Vesicle::push_films_apart() {
  film_energy_ = most_film_pressure_ = 0;
  for (std::size_t i = 0; i < surface_.size(); i++) {
    const double thickness = surface_.thickness(i, band_), pressure = film_.pressure(thickness);
    variation_[i] -= pressure;
    most_film_pressure_ = std::max(most_film_pressure_, pressure);
    film_energy_ += surface_.weight()[i] * film_.density(thickness);
  }
}

double Vesicle::velocity(std::size_t i) const {
  const auto m = multipliers_.col(components_.of_sample(i));
  return -variation_[i] + m[0] + m[1] * surface_.KM()[i] + m[2] * surface_.K()[i] +
         (phases_ ? phases_->held().tension()[i] * surface_.KM()[i] : 0);
}

double Vesicle::max_line_speed() const { return phases_ ? phases_->max_line_speed() : 0; }

double Vesicle::relaxation_time() const {
  const double of_membrane = std::pow(grid().spacing, 4) / stiffness_of_grid();
  return phases_ ? std::min(of_membrane, phases_->relaxation_time()) : of_membrane;
}

double Vesicle::stiffness_of_grid() const {
  const double h = grid().spacing;
  return stiffness() + gradient_stiffness() / (h * h);
}

/// Where waves as short as the grid gain as much as they cost elsewhere. (A little less than
/// nothing, at a tip for a while, does no harm: the step damps short waves.)
std::string Vesicle::why_not_stiff() const {
  const double h = grid().spacing;
  if (stiffness_.least + stiffness_.least_gradient / (h * h) > -stiffness_of_grid()) return {};
  const std::size_t i = stiffness_.softest;
  const double mean = 0.5 * surface_.KM()[i],
               apart = std::sqrt(std::max(0.0, mean * mean - surface_.K()[i]));
  return fmt::format("where its principal curvatures are {:.4g} and {:.4g}, at {}, the membrane "
                     "no longer resists bending: with these moduli the energy has no lower bound. "
                     "Smaller cubic, mixed or negative moduli, or a larger quartic one, bound it",
                     mean - apart, mean + apart, place_text(surface_.point(i), grid().spacing));
}

double Vesicle::greatest_tension() const {
  return multipliers_.row(1).maxCoeff() + (phases_ ? phases_->held().greatest() : 0);
}

double Vesicle::curvature_tension() const {
  auto of = [](const SurfaceModuli& m) {
    return 0.5 * m.bending_modulus * m.spontaneous_curvature * m.spontaneous_curvature;
  };
  return std::max(of(ld_), of(lo_));
}

void Vesicle::keep_apart(double time) {
  if (constraints_.keep_apart(quantities(of_each_))) find_velocities(time);
}

bool Vesicle::set_out(double time) {
  if (!constraints_.set_out(time, quantities(of_each_))) return false;
  measure_forces(time);
  return true;
}

double Vesicle::longest_step(double time) const {
  double longest =
      std::min(constraints_.longest_step(time), film_.longest_step(most_film_pressure_));
  if (phases_ && !phases_->is_curved(time))
    longest = std::min(longest, phases_->curvature_start_time() - time);
  return longest;
}

bool Vesicle::is_driven(double from, double to) const {
  return constraints_.is_led(from, to) ||
         (phases_ && phases_->is_curved(from) != phases_->is_curved(to));
}

bool Vesicle::turns_at(double time) const {
  return constraints_.turns_at(time) ||
         (phases_ && phases_->is_curved(time) && !phases_->is_curved(time * (1 - 1e-9)));
}

EnergyTerms Vesicle::energies() const {
  EnergyTerms terms;
  energy_.find_energies(surface_, terms);
  if (phases_) phases_->find_line_energies(terms);
  if (stretch_) terms[Term::stretch] = stretch_->energy(surface_);
  if (film_.exists()) terms[Term::film] = film_energy_;
  const Quantities now = quantities(of_each_);
  terms[Term::pressure] = constraints_.potential(0, now);
  terms[Term::area_difference] = constraints_.potential(2, now);
  return terms;
}

double Vesicle::energy_scale(const EnergyTerms& terms) const {
  const double softest = std::min(ld_.bending_modulus, lo_.bending_modulus);
  double sum = 0;
  for (const Term term : {Term::bending, Term::gradient, Term::line_tension, Term::geodesic_square,
                          Term::normal_square, Term::torsion_square, Term::stretch, Term::film})
    sum += terms.value(term);
  return std::max(8 * std::numbers::pi * softest, sum);
}

double Vesicle::work_since(const Quantities& before, const Multipliers& pulled) const {
  const Quantities now = quantities(of_each_);
  if (now.cols() != before.cols()) return 0;  // vesicles met or parted
  constexpr double of_unit[] = {1, -1, -0.5}; // P dV, -sigma dA, -q/2 d int K_M
  double work = 0;
  for (const int i : constraints_.held())
    if (i < with_boundary)
      work +=
          0.5 * of_unit[i] * (multipliers_.row(i) + pulled.row(i)).dot(now.row(i) - before.row(i));
  return work;
}

Measures Vesicle::measures(double time) const {
  Measures m;
  const double A = integrals_.area(), V = integrals_.volume, radius = sphere_radius(A),
               pi = std::numbers::pi;
  m.time = time;
  m.terms = energies();
  m.energy = m.terms.sum();
  m.int_KM2 = integrals_.int_KM2();
  const Quantities now = quantities(of_each_);
  m.P = mean(multipliers_.row(0), now.row(0));
  m.sigma = mean(multipliers_.row(1), now.row(1));
  m.K_multiplier = mean(multipliers_.row(2), now.row(1));
  m.area = A;
  m.volume = V;
  m.reduced_volume = V / (4. / 3 * pi * radius * radius * radius);
  m.area_difference = -integrals_.int_KM() / (8 * pi * radius);
  m.area_drift = constraints_.drift_of(1, now, time);
  m.volume_drift = constraints_.drift_of(0, now, time);
  m.max_speed = max_speed_;
  if (phases_) {
    PhaseMeasures& p = m.phases.emplace();
    p.bending_energy_Ld = energy_.bending_Ld(surface_, phases_->share());
    p.bending_energy_Lo = m.terms.value(Term::bending) - p.bending_energy_Ld;
    p.line_energy = m.terms.sum(Seat::boundary);
    p.sigma_Ld = mean(multipliers_.row(1), now.row(3)) + phases_->held().mean_Ld();
    p.sigma_Lo = mean(multipliers_.row(1), now.row(1) - now.row(3)) + phases_->held().mean_Lo();
    p.area_Ld = integrals_.area_Ld;
    p.area_Lo = A - integrals_.area_Ld;
    p.area_Ld_drift = constraints_.drift_of(3, now, time);
    p.line_length = phases_->boundary().length();
    p.line_radius = phases_->least_radius();
    p.max_line_speed = max_line_speed();
    for (const Domain& d : phases_->domains()) (d.is_Ld ? p.domains_Ld : p.domains_Lo)++;
    m.sigma = (p.sigma_Ld * p.area_Ld + p.sigma_Lo * p.area_Lo) / A;
  }
  if (stretch_) m.stretch = stretch_->measures(surface_);
  if (!phases_ && !stretch_) m.balance.emplace();
  m.energy_rise = 0;
  const Topology topology = topology_of(grid(), phi_.nodal());
  m.components = topology.components;
  m.genus = topology.genus;
  return m;
}

std::vector<ComponentMeasures> Vesicle::component_measures(double time) const {
  std::vector<ComponentMeasures> all;
  for (int k = 0; k < components_.count(); k++) {
    const SurfaceIntegrals& of = of_each_[std::size_t(k)];
    const auto multiplier = multipliers_.col(k);
    const double radius = sphere_radius(of.area());
    ComponentMeasures& m = all.emplace_back();
    m.time = time;
    m.component = k + 1;
    m.volume = of.volume;
    m.area = of.area();
    m.reduced_volume = of.volume / (4. / 3 * std::numbers::pi * radius * radius * radius);
    m.P = multiplier[0];
    m.sigma = multiplier[1];
    m.K_multiplier = multiplier[2];
    m.int_KM = of.int_KM();
    if (phases_) m.area_Ld = of.area_Ld;
    const Samples samples = components_.samples(k);
    for (std::size_t j = 0; j < samples.count(surface_); j++) {
      const std::size_t i = samples[j];
      const double w = surface_.weight()[i];
      if (w == 0) continue;
      const Vec3 p = surface_.point(i), n = surface_.normal(i);
      for (int d = 0; d < 3; d++) m.center[d] += w * 0.5 * p[d] * p[d] * n[d] / of.volume;
      if (phases_) m.sigma += w * phases_->held().tension()[i] / m.area;
    }
  }
  return all;
}

std::vector<EvolvingField*> Vesicle::fields() {
  std::vector<EvolvingField*> all;
  if (phases_) all.push_back(&phases_->evolving());
  if (stretch_) all.push_back(&stretch_->c().evolving());
  for (CarriedField& field : materials_) all.push_back(&field.evolving());
  return all;
}

std::vector<const EvolvingField*> Vesicle::fields() const {
  const std::vector<EvolvingField*> all = const_cast<Vesicle*>(this)->fields();
  return {all.begin(), all.end()};
}

std::vector<double> Vesicle::grad_of_entries() const {
  std::vector<double> grad(band_.size(), 0);
  for (std::size_t i = 0; i < surface_.entry().size(); i++)
    grad[surface_.entry()[i]] = surface_.grad()[i];
  return grad;
}

} // namespace lamella
