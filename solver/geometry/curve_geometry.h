#pragma once
#include "levelset/taylor.h"

#include <Eigen/Core>

namespace lamella {

/// Geometry at a point of the phase boundary Gamma = {phi = psi = 0}, a curve on the membrane.
///
/// N points out of the vesicle, n along the membrane into P+ = {psi > 0}; {n, t, N} is
/// right-handed, so that P- lies to the left of t as seen from outside. On the unit sphere kn =
/// B_perp = -1, and kg = -sqrt(1 - r^2) / r on the circle of radius r around a cap P-. Curvatures
/// in 1 / length.
struct CurveGeometry {
  Eigen::Vector3d t, n, N;
  double kg;     ///< geodesic curvature n.d_s t
  double kn;     ///< normal curvature N.d_s t
  double tau_g;  ///< geodesic torsion -n.d_s N
  double B_perp; ///< curvature of the membrane across Gamma, -n.d_n N

  /// d_s t
  Eigen::Vector3d curvature() const { return kg * n + kn * N; }
  /// Of the membrane.
  double KM() const { return kn + B_perp; }
  double K() const { return kn * B_perp - tau_g * tau_g; }
};

/// The geometry from phi and psi at a point; off Gamma, that of the curve phi = const, psi = const
/// through it. Neither need be a distance. Not finite where the gradients are parallel.
CurveGeometry curve_geometry(const Taylor& phi, const Taylor& psi);

/// One Newton step across the curve, towards phi = psi = 0.
Eigen::Vector3d step_to_boundary(const Taylor& phi, const Taylor& psi, const CurveGeometry& at);

} // namespace lamella
