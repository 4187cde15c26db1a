#include "levelset/quadrature.h"

#include <algorithm>
#include <cmath>

namespace lamella {

namespace {

constexpr double centre = 0.5 * (QuadratureKernel::begin + QuadratureKernel::end);
constexpr double radius = 0.5 * (QuadratureKernel::end - QuadratureKernel::begin);
constexpr double beta =
    11.8; // just under 2 pi radius, where the transform's first side lobe begins

double profile(double u) { return std::exp(beta * (std::sqrt(1 - u * u) - 1)); }

/// The profile on u in [-1, 1], scaled to int = 1 over d/h; linear between 4096 intervals, 1e-6 of
/// its peak.
class Table {
public:
  Table() {
    double sum = 0;
    for (int i = 0; i <= intervals; i++) {
      value_[i] = profile(2. * i / intervals - 1);
      sum += value_[i];
    }
    for (double& v : value_)
      v *= intervals / (2 * radius * sum); // trapezoidal rule; the ends are e^-beta
  }
  double operator()(double u) const {
    const double r = 0.5 * (u + 1) * intervals;
    const int i = int(r);
    return value_[i] + (r - i) * (value_[i + 1] - value_[i]);
  }

private:
  static constexpr int intervals = 4096;
  double value_[intervals + 1];
};

} // namespace

double QuadratureKernel::weight(double d, double KM, double K, double h) {
  static const Table table;
  const double u = (d / h - centre) / radius;
  if (!(std::abs(u) < 1)) return 0;
  constexpr double least_steiner = 0.05; // beyond the focal points of an unresolved rim
  return h * h * table(u) / std::max(least_steiner, 1 - d * KM + d * d * K);
}

} // namespace lamella
