#include "levelset/gauge.h"

#include "parallel.h"

#include <algorithm>
#include <cmath>

namespace lamella {

namespace {
constexpr double filter_strength = 1.4; // 2 is the limit of stability
constexpr std::size_t nodes_per_task = 512;

/// sum_d delta_d^4 c at a node, periodic.
double fourth_differences(const Grid& grid, const double* c, int node) {
  const int nx = grid.nx(), ny = grid.ny(), nz = grid.nz(), nxy = nx * ny;
  const int i = node % nx, j = node / nx % ny, k = node / nxy;
  auto line = [&](int at, int n, int stride) {
    const double* p = c + node - std::ptrdiff_t(at) * stride;
    auto value = [&](int m) { return p[std::ptrdiff_t((at + m + n) % n) * stride]; };
    if (at >= 2 && at + 2 < n) {
      const double* q = c + node;
      return q[-2 * stride] + q[2 * stride] - 4 * (q[-stride] + q[stride]) + 6 * q[0];
    }
    return value(-2) + value(2) - 4 * (value(-1) + value(1)) + 6 * value(0);
  };
  return line(i, nx, 1) + line(j, ny, nx) + line(k, nz, nxy);
}

} // namespace

double noise_damping(const Grid& grid, std::span<const double> c, int node) {
  return -filter_strength / 48 * fourth_differences(grid, c.data(), node);
}

Gauge::Gauge(const Grid& grid) : change_(grid.size(), 0.0) {}

void Gauge::filter(LevelSet& phi, const NarrowBand& band, double share) {
  if (share == 0) return;
  const std::span<double> c = phi.coefficients();
  const std::span<const int> node = band.node();
  at_point_.resize(band.size());
  parallel_for(band.size(), nodes_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; s++)
      change_[node[s]] = share * band.taper()[s] * noise_damping(phi.grid(), c, node[s]);
  });
  SplineView change = phi.view();
  change.coefficients = change_.data();
  parallel_for(band.size(), nodes_per_task, [&](std::size_t begin, std::size_t end) {
    const ConstPoints p = band.points();
    kernels().cubic(change, end - begin, {p.x + begin, p.y + begin, p.z + begin},
                    &at_point_[begin]);
  });
  parallel_for(band.size(), nodes_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; s++) {
      c[node[s]] += change_[node[s]] - band.taper()[s] * at_point_[s];
      change_[node[s]] = 0;
    }
  });
}

double Gauge::renormalise(LevelSet& phi, const NarrowBand& band, std::span<const double> grad,
                          Extension& extension, Fourier& fourier) const {
  const Grid& grid = phi.grid();
  const std::size_t plane = std::size_t(grid.nx()) * grid.ny();
  const double mean = gauge_range(band, grad).mean;
  std::vector<double> ratio(band.size());
  for (std::size_t s = 0; s < band.size(); s++)
    ratio[s] = std::clamp(mean / std::max(grad[s], 1e-12), 1 / 3., 3.);
  extension.fill(band, ratio);

  // Smooth over 1.5 spacings: sheets closer than that share a factor, which the zero set does not
  // mind.
  const double length4 = std::pow(1.5 * grid.spacing, 4);
  auto smooth = [&](int ky, int kz, std::complex<double>* row) {
    const double across = fourier.k2(1, ky) + fourier.k2(2, kz);
    for (int kx = 0; kx < fourier.row_modes(); kx++) {
      const double k2 = across + fourier.k2(0, kx);
      row[kx] /= (1 + length4 * k2 * k2) * double(grid.size());
    }
  };
  Array<double> target(grid.size());
  std::span<double> c = phi.coefficients();
  auto multiply = [&](int k, const double* factor) {
    for (std::size_t i = k * plane, m = 0; m < plane; i++, m++) {
      const double f = std::max(0.2, factor[m]) / mean;
      target[i] = phi.nodal()[i] * f;
      c[i] *= f;
    }
  };
  phi.update_nodal();
  fourier.apply([&](int k, double* out) { extension.plane(k, out); }, smooth, multiply);
  phi.fit(target, fourier);
  return 1 / mean;
}

GaugeRange gauge_range(const NarrowBand& band, std::span<const double> grad) {
  double least = 1e300, greatest = 0, logs = 0;
  std::size_t count = 0;
  for (std::size_t s = 0; s < band.size(); s++) {
    if (std::abs(band.distance()[s]) > band.grid().spacing) continue;
    least = std::min(least, grad[s]);
    greatest = std::max(greatest, grad[s]);
    logs += std::log(std::max(1e-12, grad[s]));
    count++;
  }
  const double mean = count ? std::exp(logs / double(count)) : 1;
  return {least / mean, greatest / mean, mean};
}

} // namespace lamella
