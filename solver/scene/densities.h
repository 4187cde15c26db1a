#pragma once
#include "expression/formula.h"
#include "scene/scene.h"

#include <string>
#include <string_view>
#include <vector>

namespace lamella {

/// A density of a scene: the key that gives it, its formula, and what this may speak of.
struct Density {
  std::string_view key; ///< such as ld.density
  std::string text;
  FormulaNames names;
};

/// Those that a scene has: on the membrane functions of its curvatures KM = K_M and K, on the phase
/// boundary of its curvatures kg, kn and tau_g.
std::vector<Density> densities_of(const Scene& scene);

/// What a density on the membrane, or on the phase boundary, may speak of.
FormulaNames names_on_membrane(const Parameters& parameters);
FormulaNames names_on_line(const Parameters& parameters);

/// Whether a parameter may have this name: not that of a function, nor of what densities depend on.
bool is_parameter_name(std::string_view name);

} // namespace lamella
