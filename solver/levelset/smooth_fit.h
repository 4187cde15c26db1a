#pragma once
#include "grid/fourier.h"

#include <vector>

namespace lamella {

/// Spline coefficients of corrections that come as nodal values: exact for what is long, less and
/// less for what is shorter than about eight spacings, so that a correction made again and again
/// does not feed what the grid cannot carry.
class SmoothFit {
public:
  SmoothFit(const Grid& grid, Fourier& fourier);

  /// Source and sink as for Fourier::apply().
  void apply(const Fourier::Source& nodal, const Fourier::Sink& coefficients) const;

private:
  Grid grid_;
  Fourier& fourier_;
  std::vector<double> k2_[3], symbol_[3]; // along each axis
};

} // namespace lamella
