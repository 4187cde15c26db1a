#pragma once
#include "energy/line_density.h"
#include "geometry/phase_boundary.h"

#include <span>
#include <vector>

namespace lamella {

/// What the energy oint l dl of a ribbon does, per length, at all points of a boundary. The ribbon
/// is the curve with a normal N at each point, that of the membrane or one near it:
///   dE = oint (-force . W + couple turn + second d_n d_n w) dl
/// for a displacement W of the curve by which n turns by `turn` towards N, w = N . W on the
/// membrane (App. B for all l at once, corrected: see docs/theory.md). Where N is the membrane's,
/// turn is d_n w + B_perp n . W.
struct LineLoads {
  std::vector<Eigen::Vector3d> force; ///< no part along t
  std::vector<double> couple;         ///< about t
  std::vector<double> second;         ///< dl/dB_perp

  LineLoads() = default;
  /// `ribbon`: one for each point of the boundary. `dn_B_perp`: the derivative of the membrane's
  /// curvature along the geodesic across the boundary, at the points, the mean of both sides;
  /// counts where l depends on B_perp, and may be empty where it does not.
  LineLoads(const LineDensity& density, const PhaseBoundary& boundary,
            std::span<const CurveGeometry> ribbon, std::span<const double> dn_B_perp = {});
};

} // namespace lamella
