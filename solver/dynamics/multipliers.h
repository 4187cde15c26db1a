#pragma once
#include "dynamics/surface_integrals.h"

namespace lamella {

/// Coefficients of the functions 1, K_M, K of the surface.
struct Multipliers {
  double P = 0;     ///< of 1: pressure
  double sigma = 0; ///< of K_M: tension

  Multipliers& operator+=(const Multipliers& other) {
    P += other.P;
    sigma += other.sigma;
    return *this;
  }
  friend Multipliers operator*(double a, Multipliers m) { return {a * m.P, a * m.sigma}; }
};

/// P and sigma for which the velocity -F + sigma K_M + P changes neither volume nor area (Eq. 80 ff.):
/// int v dA = 0, int K_M v dA = 0. On a sphere, where 1 and K_M are dependent, the least such pair.
Multipliers multipliers_at_rest(const SurfaceIntegrals& integrals);

/// The normal displacement P + sigma K_M that changes volume and area by the given amounts, to first order.
Multipliers displacement_for(const SurfaceIntegrals& integrals, double volume_change, double area_change);

} // namespace lamella
