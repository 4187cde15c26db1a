#pragma once
#include "levelset/narrow_band.h"

#include <array>
#include <span>
#include <vector>

namespace lamella {

/// A point near the membrane where grad phi = 0. The topology of {phi < 0} changes where phi there
/// passes through zero, and nowhere else.
struct CriticalPoint {
  Vec3 place{};
  double phi = 0;
  std::array<double, 3>
      stiffness{};         ///< eigenvalues of the Hessian of phi inside, -phi outside; ascending
  Vec3 across{};           ///< the direction of the largest one
  double radius = 0;       ///< distance to the membrane
  std::vector<int> around; ///< band entries of the nodes around it
};

/// The critical points on one side of the membrane within `reach` (length) of it, the nearest
/// first. `grad`: |grad phi| on the membrane, at the nearest points of the band's entries, 0 where
/// unknown.
std::vector<CriticalPoint> critical_points(const LevelSet& phi, const NarrowBand& band,
                                           std::span<const double> grad, double reach, bool inside);

} // namespace lamella
