#pragma once
#include "geometry/phase_boundary.h"

#include <vector>

namespace lamella {

/// Energy of the phase boundary, oint (kappa_l + kappa_g kg + kappa_tau tau_g + kappa_n kn) dl
/// (Eq. 85).
struct LineEnergy {
  double tension = 0;  ///< kappa_l, energy / length
  double geodesic = 0; ///< kappa_g, an energy like those below
  double torsion = 0;  ///< kappa_tau
  double normal = 0;   ///< kappa_n

  double density(const CurveGeometry& c) const {
    return tension + geodesic * c.kg + torsion * c.tau_g + normal * c.kn;
  }
  double energy(const PhaseBoundary& boundary) const {
    return boundary.integral([this](const CurveGeometry& c) { return density(c); });
  }

  /// Force per length on Gamma, g of Eq. 89 (corrected, see docs/theory.md), at all points of the
  /// boundary: dE = -oint g.W dl + oint couple d_n w dl for a displacement W of Gamma, w = N.W on
  /// the membrane.
  std::vector<Eigen::Vector3d> forces(const PhaseBoundary& boundary) const {
    const auto dkg = boundary.derivative([](const CurveGeometry& c) { return c.kg; });
    const auto dkn = boundary.derivative([](const CurveGeometry& c) { return c.kn; });
    const auto dtau = boundary.derivative([](const CurveGeometry& c) { return c.tau_g; });
    std::vector<Eigen::Vector3d> g(boundary.points().size());
    for (std::size_t i = 0; i < g.size(); i++) {
      const CurveGeometry& c = boundary.points()[i];
      g[i] = tension * c.curvature() - geodesic * (c.K() * c.n + dtau[i] * c.N) +
             torsion * ((dkg[i] - c.kn * c.tau_g) * c.N - (dkn[i] + c.kg * c.tau_g) * c.n) +
             normal * ((dtau[i] + c.kg * c.B_perp) * c.n + c.tau_g * c.tau_g * c.N);
    }
    return g;
  }
  /// Torque per length that turns the membrane about t.
  double couple(const CurveGeometry& c) const { return geodesic * c.kn - normal * c.kg; }
};

} // namespace lamella
