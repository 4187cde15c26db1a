#include "levelset/level_set.h"

#include "parallel.h"

#include <algorithm>
#include <cmath>

namespace lamella {

namespace {

SplineView spline(const Grid& grid, std::span<const double> coefficients) {
  return {coefficients.data(),
          {grid.nx(), grid.ny(), grid.nz()},
          {grid.origin(0), grid.origin(1), grid.origin(2)},
          1 / grid.spacing};
}

} // namespace

void nodal_values(const Grid& grid, std::span<const double> coefficients, std::span<double> nodal) {
  const SplineView view = spline(grid, coefficients);
  const std::size_t plane = std::size_t(grid.nx()) * grid.ny();
  parallel_for(grid.nz(), 4, [&](std::size_t begin, std::size_t end) {
    thread_local Array<double> scratch;
    scratch.resize(plane + 2 * grid.nx() + 6);
    for (std::size_t k = begin; k < end; k++)
      kernels().nodal_plane(view, int(k), scratch.data(), &nodal[k * plane]);
  });
}

LevelSet::LevelSet(const Grid& grid)
    : grid_(grid), coefficients_(grid.size(), 0.0), nodal_(grid.size(), 0.0) {}

SplineView LevelSet::view() const { return spline(grid_, coefficients_); }

void LevelSet::fit(std::span<const double> values, Fourier& fourier, int sweeps) {
  update_nodal();
  const std::size_t plane = std::size_t(grid_.nx()) * grid_.ny();
  auto residual = [&](int k, double* out) {
    for (std::size_t i = 0; i < plane; i++) out[i] = values[k * plane + i] - nodal_[k * plane + i];
  };
  std::vector<double> along(fourier.row_modes());
  for (int kx = 0; kx < fourier.row_modes(); kx++) along[kx] = fourier.spline_symbol(0, kx);
  auto invert = [&](int ky, int kz, std::complex<double>* row) {
    const double across = fourier.spline_symbol(1, ky) * fourier.spline_symbol(2, kz);
    for (int kx = 0; kx < fourier.row_modes(); kx++) {
      const double symbol = across * along[kx];
      row[kx] *= (1 - std::pow(1 - symbol, sweeps)) / (symbol * double(grid_.size()));
    }
  };
  auto add = [&](int k, const double* increment) {
    for (std::size_t i = 0; i < plane; i++) coefficients_[k * plane + i] += increment[i];
  };
  fourier.apply(residual, invert, add);
  update_nodal();
}

} // namespace lamella
