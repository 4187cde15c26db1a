#pragma once
#include "levelset/extension.h"
#include "levelset/narrow_band.h"

#include <span>
#include <vector>

namespace lamella {

/// What damps grid-scale noise of coefficients c at a node: -strength/48 sum_d delta_d^4 c.
double noise_damping(const Grid& grid, std::span<const double> c, int node);

/// Freedom in phi that the membrane does not see: {phi = 0} stays, phi around it may change.
class Gauge {
public:
  explicit Gauge(const Grid& grid);

  /// Damps grid-scale noise of the coefficients, -strength/48 sum_d delta_d^4 c in the band, less
  /// the value of that change at each node's nearest point, so that the membrane keeps its place.
  /// Without it noise in phi off the membrane grows until the step size suffers. What it is less is
  /// found by cubics, and so not all of it: the membrane moves a little, which steps take back.
  /// `share` of the strength, 0 to 1.
  void filter(LevelSet& phi, const NarrowBand& band, double share);

  /// Multiplies phi by a smooth positive factor that brings |grad phi| on the membrane to 1. `grad`
  /// holds |grad phi| at the nearest points of all band nodes. Returns the mean factor.
  double renormalise(LevelSet& phi, const NarrowBand& band, std::span<const double> grad,
                     Extension& extension, Fourier& fourier) const;

private:
  Array<double> change_; // on the grid; 0 off the band it was last filled for
  std::vector<double> at_point_;
};

/// Extremes of |grad phi| over its geometric mean, for nodes within a spacing of the membrane.
struct GaugeRange {
  double least = 1, greatest = 1, mean = 1;
};
GaugeRange gauge_range(const NarrowBand& band, std::span<const double> grad);

} // namespace lamella
