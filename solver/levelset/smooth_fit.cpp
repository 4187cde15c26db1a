#include "levelset/smooth_fit.h"

#include <algorithm>
#include <cmath>

namespace lamella {

namespace {
constexpr double length = 1; // spacings; times 2 pi it is the wavelength of which half is kept
constexpr double least_symbol = 0.25;
} // namespace

SmoothFit::SmoothFit(const Grid& grid, Fourier& fourier) : grid_(grid), fourier_(fourier) {
  for (int axis = 0; axis < 3; axis++)
    for (int m = 0; m < (axis == 0 ? fourier.row_modes() : grid.nodes[axis]); m++) {
      k2_[axis].push_back(fourier.k2(axis, m));
      symbol_[axis].push_back(std::max(least_symbol, fourier.spline_symbol(axis, m)));
    }
}

void SmoothFit::apply(const Fourier::Source& nodal, const Fourier::Sink& coefficients) const {
  const double length4 = std::pow(length * grid_.spacing, 4);
  auto fit = [&](int ky, int kz, std::complex<double>* row) {
    const double across = k2_[1][ky] + k2_[2][kz],
                 scale = 1 / (symbol_[1][ky] * symbol_[2][kz] * double(grid_.size()));
    for (std::size_t kx = 0; kx < k2_[0].size(); kx++) {
      const double k2 = across + k2_[0][kx];
      row[kx] *= scale / (symbol_[0][kx] * (1 + length4 * k2 * k2));
    }
  };
  fourier_.apply(nodal, fit, coefficients);
}

} // namespace lamella
