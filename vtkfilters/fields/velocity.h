#pragma once
#include "levelset/level_set.h"
#include "scene/scene.h"
#include "store/frame.h"

#include <vtkPoints.h>

#include <optional>
#include <vector>

namespace lamella {

/// Coefficients of 1, K_M, K in the normal velocity; with phases the second is that of Lo.
struct KnownMultipliers {
  double P = 0, sigma = 0, K_multiplier = 0;
  double sigma_Ld = 0; ///< with phases
};

/// Normal velocity of the membrane of a frame at points on it, by the forces of the scene: its
/// curvatures, the phase boundary, local stretch, films.
std::vector<double> normal_velocity(const Frame& frame, const LevelSet& phi, const Scene& scene,
                                    const KnownMultipliers& multipliers, vtkPoints& points);

} // namespace lamella
