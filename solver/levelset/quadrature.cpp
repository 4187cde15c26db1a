#include "levelset/quadrature.h"

#include <algorithm>
#include <cmath>

namespace lamella {

namespace {

constexpr double centre = 0.5 * (QuadratureKernel::begin + QuadratureKernel::end);
constexpr double radius = 0.5 * (QuadratureKernel::end - QuadratureKernel::begin);
constexpr double beta = 11.8; // just under 2 pi radius, where the transform's first side lobe begins

double profile(double u) { return std::exp(beta * (std::sqrt(1 - u * u) - 1)); }

/// 1 / int of the profile over d/h.
double normalisation() {
  constexpr int n = 4000; // midpoint rule; the profile ends at e^-beta
  double sum = 0;
  for (int i = 0; i < n; i++) sum += profile(-1 + (i + 0.5) * 2 / n);
  return n / (2 * radius * sum);
}

} // namespace

double QuadratureKernel::weight(double d, double KM, double K, double h) {
  static const double norm = normalisation();
  const double u = (d / h - centre) / radius;
  if (!(std::abs(u) < 1)) return 0;
  constexpr double least_steiner = 0.05; // beyond the focal points of an unresolved rim
  return h * h * norm * profile(u) / std::max(least_steiner, 1 - d * KM + d * d * K);
}

} // namespace lamella
