#include "dynamics/semi_implicit.h"

#include "parallel.h"

#include <algorithm>

namespace lamella {

namespace {
constexpr double blend = 1;               // z0: modes with z above it are mostly Euler
constexpr double least_history = 0.5;      // of SBDF2, for stiff modes too: halves their lag; stable to 1.5 times the symbol
constexpr double least_spline_symbol = 0.25; // along an axis; nodal rates become coefficient rates no further
} // namespace

SemiImplicit::SemiImplicit(const Grid& grid, Fourier& fourier)
    : grid_(grid), fourier_(fourier), rate_(fourier.modes(), 0.0), spectral_increment_(fourier.modes(), 0.0),
      increment_(grid.size(), 0.0), previous_(grid.size(), 0.0), before_(grid.size(), 0.0) {
  auto symbol = [&](int axis, int m) { return std::max(least_spline_symbol, fourier.spline_symbol(axis, m)); };
  for (int m = 0; m < fourier.row_modes(); m++)
    for (int part = 0; part < 2; part++) {
      kx2_.push_back(fourier.k2(0, m));
      inv_symbol_x_.push_back(1 / symbol(0, m));
    }
  for (int axis = 1; axis < 3; axis++)
    for (int m = 0; m < grid.nodes[axis]; m++) {
      k2_[axis - 1].push_back(fourier.k2(axis, m));
      symbol_[axis - 1].push_back(symbol(axis, m));
    }
}

void SemiImplicit::advance(LevelSet& phi, const Extension& rates, double dt, const ImplicitSymbol& symbol) {
  ratio_ = last_dt_ > 0 ? dt / last_dt_ : 0;
  last_dt_ = dt;
  increment_.swap(previous_);
  const std::size_t plane = std::size_t(grid_.nx()) * grid_.ny();
  auto step = [&](int ky, int kz, std::complex<double>* row) {
    const std::size_t at = fourier_.row_index(ky, kz);
    const SpectralRow r{fourier_.row_modes(),
                        kx2_.data(),
                        inv_symbol_x_.data(),
                        k2_[0][ky] + k2_[1][kz],
                        1 / (symbol_[0][ky] * symbol_[1][kz] * double(grid_.size())),
                        dt,
                        ratio_,
                        symbol.stiffness,
                        symbol.tension,
                        blend,
                        least_history};
    kernels().spectral_row(r, reinterpret_cast<double*>(row), reinterpret_cast<double*>(&rate_[at]),
                           reinterpret_cast<double*>(&spectral_increment_[at]));
  };
  double* c = phi.coefficients().data();
  auto add = [&](int k, const double* increment) {
    double *out = &increment_[k * plane], *ck = c + k * plane, *before = &before_[k * plane];
    for (std::size_t i = 0; i < plane; i++) {
      out[i] = increment[i];
      before[i] = ck[i];
      ck[i] += increment[i];
    }
  };
  fourier_.apply([&](int k, double* out) { rates.plane(k, out); }, step, add);
}

void SemiImplicit::rescale(double factor) {
  for (auto* modes : {&rate_, &spectral_increment_})
    for (auto& m : *modes) m *= factor;
  for (double& d : increment_) d *= factor;
}

} // namespace lamella
