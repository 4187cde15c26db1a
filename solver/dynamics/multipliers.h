#pragma once
#include "dynamics/surface_integrals.h"

namespace lamella {

/// Coefficients of the functions 1, K_M, K of the surface.
struct Multipliers {
  double P = 0;     ///< of 1: pressure
  double sigma = 0; ///< of K_M: tension
};

/// P and sigma for which the velocity -F + sigma K_M + P changes neither volume nor area (Eq. 80
/// ff.): int v dA = 0, int K_M v dA = 0. On a sphere, where 1 and K_M are dependent, the least such
/// pair.
Multipliers multipliers_at_rest(const SurfaceIntegrals& integrals);

/// The normal displacement P + sigma K_M that changes volume and area by the given amounts, to
/// first order.
Multipliers displacement_for(const SurfaceIntegrals& integrals, double volume_change,
                             double area_change);

/// Solves m x = b with rows and columns scaled to unit norm and directions of singular value below
/// 1e-4 damped out: on a sphere volume and area say the same, and what they differ by is noise.
/// (1e-4 is about the relative variance of K_M at a reduced volume of 0.9999.)
Eigen::Vector2d solve_scaled(const Eigen::Matrix2d& m, const Eigen::Vector2d& b);

} // namespace lamella
