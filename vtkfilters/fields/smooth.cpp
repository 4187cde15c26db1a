#include "fields/smooth.h"

#include "grid/fourier.h"
#include "parallel.h"

#include <unsupported/Eigen/SpecialFunctions>

#include <algorithm>
#include <cmath>

namespace lamella {

void level_off(const Grid& grid, std::vector<double>& phi) {
  const double shortest = grid.spacing * *std::ranges::min_element(grid.nodes);
  const double width = std::max(16 * grid.spacing, shortest / 4);
  const auto beyond = [width](double value) { return std::abs(value) > width * (1 + 1e-9); };
  if (std::ranges::any_of(phi, beyond))
    for (double& value : phi) value = width * std::tanh(value / width);
}

void blur(const Grid& grid, double width, std::vector<double>& values) {
  Fourier fourier(grid);
  const std::size_t plane = std::size_t(grid.nx()) * grid.ny();
  const double variance = width * width * grid.spacing * grid.spacing;
  std::vector<double> blurred(values.size());
  const auto read = [&](int k, double* out) { std::copy_n(&values[k * plane], plane, out); };
  const auto damp = [&](int ky, int kz, std::complex<double>* row) {
    for (int kx = 0; kx < fourier.row_modes(); ++kx) {
      const double k2 = fourier.k2(0, kx) + fourier.k2(1, ky) + fourier.k2(2, kz);
      row[kx] *= std::exp(-0.5 * variance * k2) / double(grid.size());
    }
  };
  const auto write = [&](int k, const double* in) { std::copy_n(in, plane, &blurred[k * plane]); };
  fourier.apply(read, damp, write);
  values = std::move(blurred);
}

/// A plane edge, blurred by a Gaussian, is the normal distribution of the distance from it.
std::vector<double> from_share(const Grid& grid, double width, std::vector<double> share) {
  constexpr double least = 1e-12; // of a share: 7 standard deviations
  blur(grid, width, share);
  parallel_for(share.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      share[i] =
          -width * grid.spacing * Eigen::numext::ndtri(std::clamp(share[i], least, 1 - least));
  });
  return share;
}

} // namespace lamella
