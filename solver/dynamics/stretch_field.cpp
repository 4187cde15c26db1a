#include "dynamics/stretch_field.h"

#include "levelset/taylor.h"

#include <algorithm>
#include <cmath>

namespace lamella {

namespace {
using Eigen::Vector3d;
} // namespace

StretchField::StretchField(double modulus, const Grid& grid, Fourier& fourier)
    : law_{modulus}, c_("c", Carried::amount, grid, fourier) {
  std::ranges::fill(c_.evolving().spline().coefficients(), 1.0);
}

void StretchField::add_variation(const SurfaceGeometry& surface,
                                 std::span<double> variation) const {
  for (std::size_t i = 0; i < variation.size(); i++) {
    const double c = c_.jets()[i].f;
    variation[i] -= law_.at(c).tension(c) * surface.KM()[i];
  }
}

std::vector<double> StretchField::flow_across(std::span<const Vector3d> points,
                                              std::span<const Vector3d> n) const {
  const std::vector<Taylor> t = taylor(c_.spline(), points);
  std::vector<double> flow;
  for (std::size_t i = 0; i < points.size(); i++)
    flow.push_back(-t[i].value * law_.at(t[i].value).d2 * t[i].gradient.dot(n[i]));
  return flow;
}

double StretchField::rate(std::size_t i, double KM, double v) const {
  const SurfaceJet<double>& c = c_.jets()[i];
  const StretchEnergy::Value e = law_.at(c.f);
  return c_.rate(i, KM, v) + c.f * c.f * e.d2 * c.lap +
         (2 * c.f * e.d2 + c.f * c.f * e.d3) * dot(c.grad, c.grad);
}

StretchMeasures StretchField::measures(const SurfaceGeometry& surface) const {
  StretchMeasures m{1e300, -1e300};
  for (std::size_t i = 0; i < surface.size(); i++) {
    if (surface.weight()[i] == 0) continue;
    m.least = std::min(m.least, c_.jets()[i].f);
    m.greatest = std::max(m.greatest, c_.jets()[i].f);
  }
  return m;
}

double StretchField::energy(const SurfaceGeometry& surface) const {
  double energy = 0;
  for (std::size_t i = 0; i < surface.size(); i++)
    if (const double w = surface.weight()[i]; w != 0) energy += w * law_.at(c_.jets()[i].f).f;
  return energy;
}

} // namespace lamella
