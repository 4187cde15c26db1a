#pragma once
#include "scene/scene.h"

#include <string_view>

namespace lamella {

/// Exponents in a unit that is told in words, as in scene/keys.cpp: "energy/length³", "1/time". All
/// are 0 for what has none of the three in it ("", "degrees", "grid spacings", "seconds" of
/// wall-clock time).
struct Dimension {
  int length = 0, energy = 0, time = 0;

  bool operator==(const Dimension&) const = default;
};
Dimension dimension_of(std::string_view unit);

/// Other units of length and energy, as factors of the numbers that are given in them. Time
/// follows: the drag coefficient of the membrane is 1, so its unit is length^4 / energy.
struct UnitChange {
  double length = 1, energy = 1;

  /// By what a number in this unit is multiplied.
  double factor(std::string_view unit) const;
};

/// The same physics in other units: every value of scene/keys.cpp with a unit is converted.
Scene in_units(Scene scene, const UnitChange& change);

} // namespace lamella
