#pragma once
#include "geometry/surface_geometry.h"

#include <span>

namespace lamella {

/// Bending energy kappa/2 int (K_M - C)^2 dA.
struct Helfrich {
  double bending_modulus = 1;       ///< kappa
  double spontaneous_curvature = 0; ///< C, in the sign of K_M (-2 on the unit sphere)

  double density(double KM) const {
    const double d = KM - spontaneous_curvature;
    return 0.5 * bending_modulus * d * d;
  }

  /// Variation of the energy with a normal displacement u: dE = int F u dA,
  /// F = kappa [Lap_s K_M + K_M^3/2 - 2 K_M K + 2 C K - C^2 K_M / 2]; the membrane feels -F (Eq.
  /// 80).
  double variation(double KM, double K, double lap_KM) const {
    const double C = spontaneous_curvature;
    return bending_modulus *
           (lap_KM + 0.5 * KM * KM * KM - 2 * KM * K + 2 * C * K - 0.5 * C * C * KM);
  }
};

} // namespace lamella
