#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace lamella {

std::string_view to_string(Carried carried) {
  return carried == Carried::value ? "value" : "amount";
}

Grid Scene::grid() const { return {nodes, 2 * half_width / *std::ranges::min_element(nodes)}; }

std::vector<std::string> Scene::evolving_fields() const {
  std::vector<std::string> names;
  if (has_phases()) names.emplace_back("psi");
  if (stretch.modulus > 0) names.emplace_back("c");
  for (const MaterialField& field : fields) names.push_back(field.name);
  return names;
}

double Scene::stiffest() const {
  return has_phases() ? std::max(ld.bending_modulus, lo.bending_modulus) : membrane.bending_modulus;
}

double Scene::end() const {
  return end_time > 0 ? end_time : 1.6e-3 * std::pow(half_width, 4) / stiffest();
}

double Scene::longest_step() const {
  return numerics.max_time_step > 0 ? numerics.max_time_step : end() / 16;
}

} // namespace lamella
