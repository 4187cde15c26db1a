#include "dynamics/measures.h"

namespace lamella {

std::vector<EnergyTerm> energy_terms(const Measures& m) {
  std::vector<EnergyTerm> terms;
  const auto add = [&](std::string_view name, const std::optional<double>& value) {
    if (value) terms.push_back({name, *value});
  };
  if (m.phases) {
    add("bending of Ld", m.phases->bending_energy_Ld);
    add("bending of Lo", m.phases->bending_energy_Lo);
    add("Gaussian curvature", m.phases->gaussian_energy);
    add("the length of the phase boundary", m.phases->line_terms.tension);
    add("the geodesic curvature of the phase boundary", m.phases->line_terms.geodesic);
    add("the geodesic torsion of the phase boundary", m.phases->line_terms.torsion);
    add("the normal curvature of the phase boundary", m.phases->line_terms.normal);
    add("the squared geodesic curvature of the phase boundary",
        m.phases->line_terms.geodesic_square);
    add("the squared geodesic torsion of the phase boundary", m.phases->line_terms.torsion_square);
    add("the squared normal curvature of the phase boundary", m.phases->line_terms.normal_square);
  } else {
    add("bending", m.bending_energy);
  }
  if (m.stretch) add("stretch", m.stretch->energy);
  add("pressure", m.pressure_energy);
  add("the area difference", m.area_difference_energy);
  add("the disjoining pressure of films", m.film_energy);
  return terms;
}

} // namespace lamella
