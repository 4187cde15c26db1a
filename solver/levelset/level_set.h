#pragma once
#include "grid/fourier.h"
#include "grid/grid.h"
#include "grid/memory.h"
#include "kernels/kernels.h"

#include <span>
#include <vector>

namespace lamella {

/// Nodal values of the degree-7 tensor B-spline with these coefficients on a periodic grid.
void nodal_values(const Grid& grid, std::span<const double> coefficients, std::span<double> nodal);

/// A smooth level set: degree-7 tensor B-spline on a periodic grid, negative inside the membrane
/// {phi = 0}. phi need not be a distance; |grad phi| on the membrane should be of order 1 (see
/// gauge.h).
class LevelSet {
public:
  explicit LevelSet(const Grid& grid);

  const Grid& grid() const { return grid_; }
  SplineView view() const;

  std::span<double> coefficients() { return coefficients_; }
  std::span<const double> coefficients() const { return coefficients_; }
  /// Values at the nodes, as of the last update_nodal() or fit().
  std::span<const double> nodal() const { return nodal_; }

  void update_nodal() { nodal_values(grid_, coefficients_, nodal_); }

  /// Coefficients whose nodal values are `values`, but for grid-scale content (kinks far from the
  /// membrane), which the spline would turn into ringing: the result of `sweeps` sweeps c <- c +
  /// (values - nodal(c)), found at once in Fourier space.
  void fit(std::span<const double> values, Fourier& fourier, int sweeps = 8);

private:
  Grid grid_;
  Array<double> coefficients_, nodal_;
};

} // namespace lamella
