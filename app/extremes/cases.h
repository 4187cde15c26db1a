#pragma once
#include "scene/scene.h"

#include <span>
#include <string_view>

namespace lamella {

/// What is known of how a case ends.
enum class Known {
  nothing,
  oblate,     ///< the exact equilibrium of its reduced volume on the oblate branch
  prolate,    ///< on the prolate branch
  relaxation, ///< the exact axisymmetric relaxation of the oblate with v = 0.6 over time
  sphere,     ///< int K_M^2 dA = 16 pi
  pear,       ///< E = 1.472113 x 8 pi kappa: v = 0.9, Da = 1.10
  triangle    ///< E = 1.96706 x 8 pi kappa: v = 0.6, Da = 1.05
};

/// A run at a limit of the method.
struct ExtremeCase {
  std::string_view name;
  std::string_view scene; ///< a built-in one, then what is --set of it, with blanks between
  Known known = Known::nothing;
  bool quick = false; ///< one of --quick
};

std::span<const ExtremeCase> extreme_cases();

/// Throws SceneError where the scene is refused.
Scene scene_of(const ExtremeCase& which);

} // namespace lamella
