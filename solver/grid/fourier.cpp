#include "grid/fourier.h"

#include "parallel.h"

#include <cmath>
#include <cstring>
#include <fftw3.h>
#include <mutex>
#include <numbers>

namespace lamella {

namespace {
fftw_complex* raw(std::complex<double>* p) { return reinterpret_cast<fftw_complex*>(p); }
std::mutex planner; // FFTW plans in one thread at a time

} // namespace

/// Single-threaded plans, executed on many planes and column blocks at once: results do not depend
/// on the number of threads. FFTW_ESTIMATE, so that they do not depend on the run either.
struct Fourier::Plans {
  fftw_plan plane_forward, plane_backward, columns_forward, columns_backward;

  explicit Plans(const Grid& grid) {
    const std::lock_guard lock(planner);
    const int nx = grid.nx(), ny = grid.ny(), nz = grid.nz(), row = nx / 2 + 1;
    Array<double> plane(std::size_t(nx) * ny);
    Array<std::complex<double>> modes(std::size_t(row) * std::max(ny, nz));
    plane_forward = fftw_plan_dft_r2c_2d(ny, nx, plane.data(), raw(modes.data()), FFTW_ESTIMATE);
    plane_backward = fftw_plan_dft_c2r_2d(ny, nx, raw(modes.data()), plane.data(), FFTW_ESTIMATE);
    auto columns = [&](int direction) {
      return fftw_plan_many_dft(1, &nz, row, raw(modes.data()), nullptr, row, 1, raw(modes.data()),
                                nullptr, row, 1, direction, FFTW_ESTIMATE);
    };
    columns_forward = columns(FFTW_FORWARD);
    columns_backward = columns(FFTW_BACKWARD);
  }
  ~Plans() {
    const std::lock_guard lock(planner);
    for (fftw_plan p : {plane_forward, plane_backward, columns_forward, columns_backward})
      fftw_destroy_plan(p);
  }
  Plans(const Plans&) = delete;
};

Fourier::Fourier(const Grid& grid)
    : grid_(grid), plans_(std::make_unique<Plans>(grid)), modes_(modes()) {}
Fourier::~Fourier() = default;

void Fourier::apply(const Source& source, const Modify& modify, const Sink& sink) {
  const int ny = grid_.ny(), nz = grid_.nz(), row = row_modes();
  const std::size_t plane_nodes = std::size_t(grid_.nx()) * ny, plane_modes = std::size_t(row) * ny;
  parallel_for(nz, 1, [&](std::size_t k, std::size_t) {
    thread_local Array<double> plane;
    plane.resize(plane_nodes);
    source(int(k), plane.data());
    fftw_execute_dft_r2c(plans_->plane_forward, plane.data(), raw(&modes_[k * plane_modes]));
  });
  parallel_for(ny, 1, [&](std::size_t ky, std::size_t) {
    thread_local Array<std::complex<double>> block;
    block.resize(std::size_t(row) * nz);
    const std::size_t bytes = row * sizeof block[0];
    for (int kz = 0; kz < nz; kz++)
      std::memcpy(&block[kz * row], &modes_[kz * plane_modes + ky * row], bytes);
    fftw_execute_dft(plans_->columns_forward, raw(block.data()), raw(block.data()));
    for (int kz = 0; kz < nz; kz++) modify(int(ky), kz, &block[kz * row]);
    fftw_execute_dft(plans_->columns_backward, raw(block.data()), raw(block.data()));
    for (int kz = 0; kz < nz; kz++)
      std::memcpy(&modes_[kz * plane_modes + ky * row], &block[kz * row], bytes);
  });
  parallel_for(nz, 1, [&](std::size_t k, std::size_t) {
    thread_local Array<double> plane;
    plane.resize(plane_nodes);
    fftw_execute_dft_c2r(plans_->plane_backward, raw(&modes_[k * plane_modes]), plane.data());
    sink(int(k), plane.data());
  });
}

double Fourier::k2(int axis, int m) const {
  const int n = grid_.nodes[axis];
  const double k = 2 * std::numbers::pi * (m <= n / 2 ? m : m - n) / grid_.length(axis);
  return k * k;
}

double Fourier::spline_symbol(int axis, int m) const {
  const double t = 2 * std::numbers::pi * m / grid_.nodes[axis];
  return (2416 + 2 * (1191 * std::cos(t) + 120 * std::cos(2 * t) + std::cos(3 * t))) / 5040;
}

} // namespace lamella
