#pragma once
#include "dynamics/event.h"
#include "levelset/critical_points.h"
#include "levelset/level_set.h"

namespace lamella {

/// A place where the inside is about to part: a neck, a film, or a last rest.
struct Closing {
  Event::Kind kind; ///< fission, rupture, vanished
  CriticalPoint at;
  double grad; ///< |grad phi| on the membrane there
};

/// When a place parts. Lengths in grid spacings.
struct ClosingRule {
  /// Grid spacings; below, the grid cannot hold a neck or a film open.
  static constexpr double hopeless_neck = 0.95, hopeless_film = 0.6;

  double bending_modulus = 1;
  double rupture_thickness = 0; ///< length, of films; 0: where the grid ceases to resolve them

  /// One stiff direction, across.
  static bool is_film(const CriticalPoint& point);

  /// How far inside the membrane critical points need be looked for; a length.
  double reach(double spacing) const;
  /// Those further inside than this do not part yet.
  double least_reach(double spacing) const;

  /// Whether a critical point inside is such a place. `speed`: at which the membrane around closes
  /// in on it.
  bool parts(const CriticalPoint& point, double speed, double spacing, Event::Kind& kind) const;
};

/// Lifts phi above zero at the place, smoothly and no further than needed.
void part(LevelSet& phi, const Closing& place);

} // namespace lamella
