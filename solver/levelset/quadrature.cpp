#include "levelset/quadrature.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lamella {

namespace {

// A little under pi times the width of the kernel, where its transform's first side lobe begins.
constexpr double beta_of(double width) { return 2.95 * width; }

double profile(double u, double beta) { return std::exp(beta * (std::sqrt(1 - u * u) - 1)); }

/// The profile on u in [-1, 1], scaled to int = 1 over d/h; linear between 4096 intervals, 1e-6 of
/// its peak.
class Table {
public:
  explicit Table(double width) {
    double sum = 0;
    for (int i = 0; i <= intervals; i++) {
      value_[i] = profile(2. * i / intervals - 1, beta_of(width));
      sum += value_[i];
    }
    for (double& v : value_)
      v *= intervals / (width * sum); // trapezoidal rule; the ends are e^-beta
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

/// Kernels that end between 1 and 3 spacings, in steps.
class Tables {
public:
  static constexpr double earliest_end = 1;
  Tables() {
    for (int i = 0; i <= steps; i++) table_.emplace_back(width(i));
  }
  static int nearest(double end) {
    const double share = (end - earliest_end) / (QuadratureKernel::end - earliest_end);
    return int(std::lround(std::clamp(share, 0.0, 1.0) * steps));
  }
  static double width(int i) {
    return earliest_end + (QuadratureKernel::end - earliest_end) * i / steps -
           QuadratureKernel::begin;
  }
  const Table& operator[](int i) const { return table_[i]; }

private:
  static constexpr int steps = 64;
  std::vector<Table> table_;
};

} // namespace

double QuadratureKernel::weight(double d, double KM, double K, double h) {
  static const Tables tables;
  constexpr double focal_share =
      1.05; // of the way to the focal point outside, where the kernel ends
  const double sharpest = 0.5 * KM + std::sqrt(std::max(0.0, 0.25 * KM * KM - K));
  const int kind = Tables::nearest(sharpest > 0 ? focal_share / (sharpest * h) : end);
  const double width = Tables::width(kind), u = 2 * (d / h - begin) / width - 1;
  if (!(std::abs(u) < 1)) return 0;
  constexpr double least_steiner = 0.05; // beyond the focal points of an unresolved rim
  return h * h * tables[kind](u) / std::max(least_steiner, 1 - d * KM + d * d * K);
}

} // namespace lamella
