#include "scene/densities.h"

#include <algorithm>

namespace lamella {

std::vector<SceneFormula> densities_of(const Scene& scene) {
  const FormulaNames membrane = names_on_membrane(scene.parameters, scene.fields);
  std::vector<SceneFormula> all;
  if (scene.has_phases()) {
    all.push_back({"ld.density", scene.ld.density, membrane});
    all.push_back({"lo.density", scene.lo.density, membrane});
    all.push_back({"line.density", scene.line.density, names_on_line(scene.parameters)});
  } else {
    all.push_back({"membrane.density", scene.membrane.density, membrane});
  }
  std::erase_if(all, [](const SceneFormula& density) { return density.text.empty(); });
  return all;
}

std::vector<SceneFormula> starts_of(const Scene& scene) {
  std::vector<SceneFormula> all;
  for (const MaterialField& field : scene.fields)
    if (!array_of(field, scene.parameters))
      all.push_back({"fields", field.start, names_in_space(scene.parameters)});
  return all;
}

FormulaNames names_on_membrane(const Parameters& parameters, const MaterialFields& fields) {
  FormulaNames names{{"KM", "K"}, parameters};
  for (const MaterialField& field : fields) names.variables.push_back(field.name);
  return names;
}

FormulaNames names_on_line(const Parameters& parameters) {
  return {{"kg", "kn", "tau_g"}, parameters};
}

FormulaNames names_in_space(const Parameters& parameters) { return {{"x", "y", "z"}, parameters}; }

std::optional<std::string> array_of(const MaterialField& field, const Parameters& parameters) {
  if (field.start.empty()) return field.name;
  const FormulaNames names = names_in_space(parameters);
  const bool is_known =
      std::ranges::count(names.variables, field.start) > 0 || parameters.contains(field.start);
  if (is_free_name(field.start) && !is_known) return field.start;
  return {};
}

bool is_name_to_give(std::string_view name) {
  const auto is_variable_of = [&](const FormulaNames& names) {
    return std::ranges::count(names.variables, name) > 0;
  };
  return is_free_name(name) && !is_variable_of(names_on_membrane({})) &&
         !is_variable_of(names_on_line({})) && !is_variable_of(names_in_space({}));
}

} // namespace lamella
