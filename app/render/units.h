#pragma once
#include "scene/scene.h"

#include <string>
#include <string_view>

namespace lamella::render {

/// What the numbers of a run's pictures are given in, whatever the units of its scene: kappa, the
/// bending modulus, with two phases that of the softer one; L, the scene's unit of length; zeta,
/// the drag coefficient, which is 1 in every scene.
struct Units {
  Units() = default;
  explicit Units(const Scene& scene);

  double kappa = 1;                 ///< in the scene's unit of energy
  std::string kappa_symbol = "*κ*"; ///< with the name of its phase where the moduli differ
};

/// As `all` of several runs: where their symbols differ, kappa stands for that of each.
Units common(const Units& a, const Units& b);

/// How a quantity is written on pictures, and what it is measured in. Texts are as Sheet::text()
/// sets them.
struct Notation {
  std::string name, letter;         ///< "pressure" and "*P*"; either may be empty
  std::string_view unit_in_scene{}; ///< in words, as in scene/keys.cpp

  /// A value of the scene, in the unit of pictures.
  double value(double in_scene, const Units& units) const;
  std::string unit(const Units& units) const; ///< "*κ*/*L*³"; empty for a plain number
  std::string symbol() const;                 ///< "pressure *P*"
  const std::string& short_symbol() const { return letter.empty() ? name : letter; }
  std::string title(const Units& units) const; ///< "pressure *P* / (*κ*/*L*³)"
};

/// "tension / (*κ*/*L*²)"; the name alone where there is no unit.
std::string with_unit(const std::string& name, const std::string& unit);

/// Of a column of history.csv, or of a field on the membrane by its name as a colour. Null for
/// others.
const Notation* find_notation(std::string_view name);
/// Of what is one of them.
const Notation& notation_of(std::string_view name);
/// Of any field on the membrane: that of a material field is its name.
Notation notation_on_membrane(std::string_view name);

/// "*t* = 1.6×10⁻³ *ζL*⁴/*κ*", "*t* = 0", of a time of the scene.
std::string time_label(double time, const Units& units);

} // namespace lamella::render
