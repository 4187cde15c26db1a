#pragma once
#include "expression/formula.h"
#include "scene/scene.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lamella {

/// A formula of a scene: the key that gives it, its text, and what this may speak of.
struct SceneFormula {
  std::string key; ///< such as ld.density
  std::string text;
  FormulaNames names;
};

/// The energy densities that a scene has: on the membrane functions of its curvatures KM = K_M and
/// K and of material fields, on the phase boundary of its curvatures kg, kn and tau_g.
std::vector<SceneFormula> densities_of(const Scene& scene);

/// Where its material fields start, those of which a formula says so.
std::vector<SceneFormula> starts_of(const Scene& scene);

/// What a density on the membrane, or on the phase boundary, or the start of a field, may speak of.
FormulaNames names_on_membrane(const Parameters& parameters, const MaterialFields& fields = {});
FormulaNames names_on_line(const Parameters& parameters);
FormulaNames names_in_space(const Parameters& parameters);

/// The array of a frame or image that a field starts from; nothing where a formula says how.
std::optional<std::string> array_of(const MaterialField& field, const Parameters& parameters);

/// Whether a parameter or field may have this name: not that of a function, nor of what formulas
/// depend on.
bool is_name_to_give(std::string_view name);

} // namespace lamella
