#include "dynamics/semi_implicit.h"

#include "parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lamella {

namespace {
// Of the part of sixth order. At a tip the layers of the band have other wave numbers than the
// membrane, which the sixth power makes much of: with a safety of 1 a prolate of reduced volume .8
// never came to rest. Waves shorter than three spacings are resisted much less than by k^6, and
// damped as by k^6 they would stay as long as there are.
constexpr double safety = 4, levelling = 0.1; // levelling in spacings^4
constexpr double least_spline_symbol =
    0.25; // along an axis; nodal rates become coefficient rates no further
double* numbers(std::complex<double>* modes) { return reinterpret_cast<double*>(modes); }
} // namespace

SemiImplicit::SemiImplicit(const Grid& grid, Fourier& fourier, int responses)
    : grid_(grid), fourier_(fourier), previous_(grid.size(), 0.0), before_(grid.size(), 0.0) {
  const Array<std::complex<double>> modes(fourier.modes(), 0.0);
  const Array<double> nodal(grid.size(), 0.0);
  memory_.rate = memory_.increment = modes;
  memory_.nodal_increment = nodal;
  memory_.responses.assign(responses, {modes, nodal});
  none_.assign(2 * fourier.row_modes(), 0.0);
  auto symbol = [&](int axis, int m) {
    return std::max(least_spline_symbol, fourier.spline_symbol(axis, m));
  };
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

SpectralRow SemiImplicit::row(int ky, int kz) const {
  return {fourier_.row_modes(),
          kx2_.data(),
          inv_symbol_x_.data(),
          k2_[0][ky] + k2_[1][kz],
          1 / (symbol_[0][ky] * symbol_[1][kz] * double(grid_.size())),
          memory_.dt,
          ratio_,
          safety * implicit_.gradient,
          levelling * std::pow(grid_.spacing, 4),
          implicit_.stiffness,
          implicit_.tension,
          blend,
          share_,
          fade};
}

void SemiImplicit::predict(const Extension& rates, double dt, const ImplicitSymbol& symbol,
                           double share) {
  ratio_ = memory_.dt > 0 ? dt / memory_.dt : 0;
  memory_.dt = dt;
  implicit_ = symbol;
  share_ = share;
  memory_.nodal_increment.swap(previous_);
  const std::size_t plane = std::size_t(grid_.nx()) * grid_.ny();
  auto step = [&](int ky, int kz, std::complex<double>* modes) {
    const std::size_t at = fourier_.row_index(ky, kz);
    kernels().spectral_row(
        row(ky, kz), numbers(modes), numbers(&memory_.rate[at]), numbers(&memory_.increment[at]),
        memory_.responses.empty() ? none_.data() : numbers(&memory_.responses[0].modes[at]),
        memory_.last_factor);
  };
  fourier_.apply([&](int k, double* out) { rates.plane(k, out); }, step,
                 [&](int k, const double* in) {
                   std::copy_n(in, plane, &memory_.nodal_increment[k * plane]);
                 });
}

void SemiImplicit::respond(int which, const Extension& rates) {
  const std::size_t plane = std::size_t(grid_.nx()) * grid_.ny();
  Response& response = memory_.responses[which];
  auto step = [&](int ky, int kz, std::complex<double>* modes) {
    kernels().euler_row(row(ky, kz), numbers(modes));
    std::copy_n(modes, fourier_.row_modes(), &response.modes[fourier_.row_index(ky, kz)]);
  };
  fourier_.apply(
      [&](int k, double* out) { rates.plane(k, out); }, step,
      [&](int k, const double* in) { std::copy_n(in, plane, &response.nodal[k * plane]); });
}

void SemiImplicit::apply(LevelSet& phi, std::span<const double> factors, double constant) {
  double* c = phi.coefficients().data();
  parallel_for(grid_.size(), 1 << 14, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = 0; r < memory_.responses.size(); r++) {
      const double* response = memory_.responses[r].nodal.data();
      for (std::size_t i = begin; i < end; i++)
        memory_.nodal_increment[i] += factors[r] * response[i];
    }
    for (std::size_t i = begin; i < end; i++) {
      memory_.nodal_increment[i] += constant;
      before_[i] = c[i];
      c[i] += memory_.nodal_increment[i];
    }
  });
  memory_.last_factor =
      memory_.responses.empty()
          ? 0
          : factors[0]; // the next predict() adds it while it reads the rows anyway
  for (std::size_t r = 1; r < memory_.responses.size(); r++)
    for (std::size_t i = 0; i < memory_.increment.size(); i++)
      memory_.increment[i] += factors[r] * memory_.responses[r].modes[i];
  memory_.increment[0] += constant;
}

void SemiImplicit::apply(LevelSet& phi, const Extension& rates, double time) {
  const std::size_t plane = std::size_t(grid_.nx()) * grid_.ny();
  auto step = [&](int ky, int kz, std::complex<double>* modes) {
    const std::size_t at = fourier_.row_index(ky, kz);
    SpectralRow over_time = row(ky, kz);
    over_time.dt = time;
    kernels().euler_row(over_time, numbers(modes));
    for (int m = 0; m < fourier_.row_modes(); m++) memory_.increment[at + m] += modes[m];
  };
  fourier_.apply([&](int k, double* out) { rates.plane(k, out); }, step,
                 [&](int k, const double* in) {
                   for (std::size_t i = 0; i < plane; i++)
                     memory_.nodal_increment[k * plane + i] += in[i];
                 });
  memory_.last_factor = 0;
  double* c = phi.coefficients().data();
  parallel_for(grid_.size(), 1 << 14, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i++) {
      before_[i] = c[i];
      c[i] += memory_.nodal_increment[i];
    }
  });
}

void SemiImplicit::rescale(double factor) {
  for (auto* modes : {&memory_.rate, &memory_.increment})
    for (auto& m : *modes) m *= factor;
  for (Response& response : memory_.responses)
    for (auto& m : response.modes) m *= factor;
  for (double& d : memory_.nodal_increment) d *= factor;
}

void SemiImplicit::shift(const std::array<int, 3>& cells) {
  for (auto* values : {&memory_.nodal_increment, &previous_, &before_})
    lamella::shift(grid_, cells, *values);
  for (Response& response : memory_.responses) lamella::shift(grid_, cells, response.nodal);
  auto phase = [&](int axis, int m) {
    return std::polar(1.0, 2 * std::numbers::pi * m * cells[axis] / grid_.nodes[axis]);
  };
  for (int ky = 0; ky < grid_.ny(); ky++)
    for (int kz = 0; kz < grid_.nz(); kz++) {
      const std::complex<double> across = phase(1, ky) * phase(2, kz);
      for (int kx = 0; kx < fourier_.row_modes(); kx++) {
        const std::size_t at = fourier_.row_index(ky, kz) + kx;
        const std::complex<double> f = across * phase(0, kx);
        memory_.rate[at] *= f;
        memory_.increment[at] *= f;
        for (Response& response : memory_.responses) response.modes[at] *= f;
      }
    }
}

} // namespace lamella
