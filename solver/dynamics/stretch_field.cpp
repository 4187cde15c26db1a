#include "dynamics/stretch_field.h"

#include "levelset/taylor.h"
#include "parallel.h"

#include <algorithm>
#include <cmath>

namespace lamella {

namespace {
using Eigen::Vector3d;

constexpr std::size_t chunk = 256;
} // namespace

StretchField::StretchField(double modulus, const Grid& grid, std::span<const double> c,
                           Fourier& fourier)
    : law_{modulus}, fit_(grid, fourier), c_(grid) {
  if (c.empty()) {
    std::ranges::fill(c_.coefficients(), 1.0);
    return;
  }
  std::ranges::copy(c, c_.coefficients().begin());
  c_.fit(c, fourier);
}

void StretchField::restore(std::span<const double> c, double lipid) {
  std::ranges::copy(c, c_.coefficients().begin());
  lipid_ = lipid;
}

void StretchField::sample(const SurfaceGeometry& surface) {
  const std::size_t n = surface.size();
  for (auto* a : {&value_, &lap_, &slope2_}) a->resize(n);
  const ConstPoints p = surface.points();
  parallel_for(n, chunk, [&](std::size_t begin, std::size_t end) {
    const std::size_t m = end - begin;
    double t[10 * chunk];
    kernels().taylor(c_.view(), m, {p.x + begin, p.y + begin, p.z + begin}, t);
    for (std::size_t i = 0; i < m; i++) {
      auto at = [&](int q) { return t[q * m + i]; };
      const Vec3 N = surface.normal(begin + i);
      const double along = at(1) * N[0] + at(2) * N[1] + at(3) * N[2];
      const double twice = N[0] * N[0] * at(4) + N[1] * N[1] * at(5) + N[2] * N[2] * at(6) +
                           2 * (N[0] * N[1] * at(7) + N[0] * N[2] * at(8) + N[1] * N[2] * at(9));
      value_[begin + i] = at(0);
      slope2_[begin + i] = at(1) * at(1) + at(2) * at(2) + at(3) * at(3) - along * along;
      lap_[begin + i] = at(4) + at(5) + at(6) - twice + surface.KM()[begin + i] * along;
    }
  });
  if (lipid_ == 0) lipid_ = integral(surface);
}

/// int c dA
double StretchField::integral(const SurfaceGeometry& surface) const {
  double sum = 0;
  for (std::size_t i = 0; i < value_.size(); i++) sum += surface.weight()[i] * value_[i];
  return sum;
}

void StretchField::add_variation(const SurfaceGeometry& surface,
                                 std::span<double> variation) const {
  for (std::size_t i = 0; i < variation.size(); i++)
    variation[i] -= law_.at(value_[i]).tension(value_[i]) * surface.KM()[i];
}

std::vector<double> StretchField::flow_across(std::span<const Vector3d> points,
                                              std::span<const Vector3d> n) const {
  const std::vector<Taylor> t = taylor(c_, points);
  std::vector<double> flow;
  for (std::size_t i = 0; i < points.size(); i++)
    flow.push_back(-t[i].value * law_.at(t[i].value).d2 * t[i].gradient.dot(n[i]));
  return flow;
}

double StretchField::rate(std::size_t i, double KM, double v) const {
  const double c = value_[i];
  const StretchEnergy::Value e = law_.at(c);
  return c * KM * v + c * c * e.d2 * lap_[i] + (2 * c * e.d2 + c * c * e.d3) * slope2_[i];
}

void StretchField::extend(const NarrowBand& band, const SurfaceGeometry& surface,
                          Extension& extension) {
  const Grid& grid = band.grid();
  c_.update_nodal();
  const ConstPoints p = band.points();
  off_.resize(band.size());
  parallel_for(band.size(), chunk, [&](std::size_t begin, std::size_t end) {
    double t[10 * chunk];
    kernels().taylor(c_.view(), end - begin, {p.x + begin, p.y + begin, p.z + begin}, t);
    for (std::size_t i = begin; i < end; i++) off_[i] = t[i - begin] - c_.nodal()[band.node()[i]];
  });
  extension.fill(band, off_);
  const double missing = (lipid_ - integral(surface)) / [&] {
    double area = 0;
    for (const double w : surface.weight()) area += w;
    return area;
  }();
  const std::size_t plane = std::size_t(grid.nx()) * grid.ny();
  std::span<double> c = c_.coefficients();
  fit_.apply([&](int k, double* out) { extension.plane(k, out); },
             [&](int k, const double* in) {
               for (std::size_t i = 0; i < plane; i++) c[k * plane + i] += in[i] + missing;
             });
}

StretchMeasures StretchField::measures(const SurfaceGeometry& surface) const {
  StretchMeasures m{1e300, -1e300};
  for (std::size_t i = 0; i < value_.size(); i++) {
    if (surface.weight()[i] == 0) continue;
    m.least = std::min(m.least, value_[i]);
    m.greatest = std::max(m.greatest, value_[i]);
  }
  return m;
}

double StretchField::energy(const SurfaceGeometry& surface) const {
  double energy = 0;
  for (std::size_t i = 0; i < value_.size(); i++)
    if (const double w = surface.weight()[i]; w != 0) energy += w * law_.at(value_[i]).f;
  return energy;
}

} // namespace lamella
