#include "scene/densities.h"

#include <algorithm>

namespace lamella {

std::vector<Density> densities_of(const Scene& scene) {
  const FormulaNames membrane = names_on_membrane(scene.parameters);
  std::vector<Density> all;
  if (scene.has_phases()) {
    all.push_back({"ld.density", scene.ld.density, membrane});
    all.push_back({"lo.density", scene.lo.density, membrane});
    all.push_back({"line.density", scene.line.density, names_on_line(scene.parameters)});
  } else {
    all.push_back({"membrane.density", scene.membrane.density, membrane});
  }
  std::erase_if(all, [](const Density& density) { return density.text.empty(); });
  return all;
}

FormulaNames names_on_membrane(const Parameters& parameters) { return {{"KM", "K"}, parameters}; }

FormulaNames names_on_line(const Parameters& parameters) {
  return {{"kg", "kn", "tau_g"}, parameters};
}

bool is_parameter_name(std::string_view name) {
  const auto is_variable_of = [&](const FormulaNames& names) {
    return std::ranges::count(names.variables, name) > 0;
  };
  return is_free_name(name) && !is_variable_of(names_on_membrane({})) &&
         !is_variable_of(names_on_line({}));
}

} // namespace lamella
