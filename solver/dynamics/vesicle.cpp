#include "dynamics/vesicle.h"

#include "error.h"
#include "levelset/topology.h"
#include "parallel.h"

#include <algorithm>
#include <cmath>
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
constexpr double longest_displacement = 0.3;
// Spacings; displaced further than that, the membrane needs samples that it did not before. (Where
// the constraints are delicate, always: curvatures feel to first order that points displaced along
// their normals are no longer the nearest ones.)
constexpr double far_displacement = 0.02;

double sphere_radius(double area) { return std::sqrt(area / (4 * std::numbers::pi)); }
} // namespace

Vesicle::Vesicle(const Scene& scene, const Start& start, Fourier& fourier)
    : bending_{scene.membrane.bending_modulus, scene.membrane.spontaneous_curvature},
      film_{scene.contact.disjoining_pressure, scene.contact.disjoining_range}, constraints_(scene),
      phi_(scene.grid()), band_(scene.grid(), band_half_width), extension_(scene.grid()) {
  std::ranges::copy(start.phi, phi_.coefficients().begin());
  phi_.fit(start.phi, fourier);
  locate();
  surface_.curvatures(phi_, band_);
  integrals_ = integrate(surface_, bending_, {});
  Quantities begin = quantities(integrals_);
  if (start.exact) {
    begin[0] = start.exact->volume;
    begin[1] = start.exact->area;
  }
  // Volume and area first: only then is the area difference that of the shape.
  Scene without = scene;
  without.area_difference = {};
  constraints_ = Constraints(without);
  constraints_.begin(begin);
  measure(0);
  if (drift(0) > worst_drift && drift(0) < start_drift) begin = quantities(integrals_); // a sphere
  begin[2] = integrals_.int_KM();
  constraints_ = Constraints(scene);
  constraints_.begin(begin);
  measure_forces(0);
}

/// Brings the membrane onto its constraints at a time and finds everything that is known of it.
/// Second derivatives suffice to measure what it is off by; what is recorded is measured after the
/// correction. Returns the excess before it.
Quantities Vesicle::measure(double time) {
  locate();
  surface_.curvatures(phi_, band_);
  integrals_ = integrate(surface_, bending_, {});
  const Quantities excess = quantities(integrals_) - constraints_.target(time);
  lead_to_constraints(time);
  return excess;
}

double Vesicle::measure_anew(double time) {
  band_.clear();
  locate();
  locate(); // some nodes of a new band find the right sheet only now
  surface_.curvatures(phi_, band_);
  const double area = integrate(surface_, bending_, {}).area();
  measure(time);
  return area;
}

void Vesicle::locate() {
  phi_.update_nodal();
  band_.update(phi_);
  surface_.sample(phi_, band_);
  if (surface_.size() == 0) throw RunError("the membrane has disappeared");
  extension_.prepare(band_, surface_.sampled());
}

double Vesicle::drift(double time) const {
  return constraints_.drift(quantities(integrals_), time);
}

/// Displaces the membrane by combinations of 1, K_M, K until it has the quantities that are held.
void Vesicle::lead_to_constraints(double time) {
  delicate_ = constraints_.is_delicate(integrals_);
  const double negligible = delicate_ ? worst_drift : negligible_drift; // it would go a long way
  if (drift(time) < negligible) return measure_forces(time);
  set_directions();
  const Eigen::Matrix3d effect = effect_of_directions();
  for (int pass = 0; pass == 0 || (pass < most_corrections && drift(time) > worst_drift); pass++) {
    displace(constraints_.combination(effect, constraints_.target(time) - quantities(integrals_)));
    measure_forces(time);
  }
}

/// The displacements 1, K_M, K of the held quantities; where the constraints are delicate, as phi
/// takes them: what a change of coefficients moves the membrane by is a little smoother than its
/// nodal values.
void Vesicle::set_directions() {
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
    if (delicate_)
      evaluate_on_membrane(nodal, moves);
    else
      for (std::size_t i = 0; i < surface_.size(); i++) moves[i] = function(i);
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
    double taylor[10 * 256];
    kernels().taylor(view, n, {p.x + begin, p.y + begin, p.z + begin}, taylor);
    for (std::size_t i = 0; i < n; i++) moves[begin + i] = taylor[i] / surface_.grad()[begin + i];
  });
  for (std::size_t s = 0; s < band_.size(); s++) field_[band_.node()[s]] = 0;
}

Eigen::Matrix3d Vesicle::effect_of_directions() const {
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

/// A combination of the directions, scaled down to the distance up to which it means something.
void Vesicle::displace(const Eigen::Vector3d& u) {
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
  if (delicate_ || greatest > far_displacement * grid().spacing) {
    locate();
    surface_.curvatures(phi_, band_);
    set_directions();
  }
}

void Vesicle::measure_forces(double time) {
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
  return -variation_[i] + multipliers_[0] + multipliers_[1] * surface_.KM()[i] +
         multipliers_[2] * surface_.K()[i];
}

bool Vesicle::set_out(double time) {
  if (!constraints_.set_out(time, quantities(integrals_))) return false;
  measure_forces(time);
  return true;
}

double Vesicle::longest_step(double time) const {
  return std::min(constraints_.longest_step(time), film_.longest_step(most_film_pressure_));
}

double Vesicle::energy() const {
  return integrals_.energy + constraints_.potential(quantities(integrals_)) + film_energy_;
}

Measures Vesicle::measures(double time) const {
  Measures m;
  const double A = integrals_.area(), V = integrals_.volume, radius = sphere_radius(A),
               pi = std::numbers::pi;
  m.time = time;
  m.bending_energy = integrals_.energy;
  m.energy = energy();
  m.int_KM2 = integrals_.int_KM2();
  m.P = multipliers_[0];
  m.sigma = multipliers_[1];
  m.K_multiplier = multipliers_[2];
  m.area = A;
  m.volume = V;
  m.reduced_volume = V / (4. / 3 * pi * radius * radius * radius);
  m.area_difference = -integrals_.int_KM() / (8 * pi * radius);
  m.area_drift = A / constraints_.target(time)[1] - 1;
  m.volume_drift = constraints_.is_held(0) ? V / constraints_.target(time)[0] - 1 : 0;
  m.max_speed = max_speed_;
  const Topology topology = topology_of(grid(), phi_.nodal());
  m.components = topology.components;
  m.genus = topology.genus;
  return m;
}

std::vector<double> Vesicle::grad_of_entries() const {
  std::vector<double> grad(band_.size(), 0);
  for (std::size_t i = 0; i < surface_.entry().size(); i++)
    grad[surface_.entry()[i]] = surface_.grad()[i];
  return grad;
}

} // namespace lamella
