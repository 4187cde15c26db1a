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

/// Kernels of 2 to 4 spacings, in steps.
class Tables {
public:
  Tables() {
    for (int i = 0; i <= steps; i++) table_.emplace_back(width(i));
  }
  static int nearest(double width) {
    return int(std::lround((width - narrowest) / (widest - narrowest) * steps));
  }
  static double width(int i) { return narrowest + (widest - narrowest) * i / steps; }
  const Table& operator[](int i) const { return table_[i]; }

private:
  static constexpr double narrowest = 2, widest = 4;
  static constexpr int steps = 64;
  std::vector<Table> table_;
};

} // namespace

double QuadratureKernel::weight(double d, double KM, double K, double h) const {
  static const Tables tables;
  constexpr double focal_share = 1.05, least = 1; // of the way to a focal point, where it ends
  const double root = std::sqrt(std::max(0.0, 0.25 * KM * KM - K));
  auto reach = [=](double most, double curvature) {
    return curvature * h * most > focal_share ? std::max(least, focal_share / (curvature * h))
                                              : most;
  };
  const double last = reach(end, 0.5 * KM + root), first = -reach(-begin, root - 0.5 * KM);
  const int kind = Tables::nearest(last - first);
  const double width = Tables::width(kind), u = 2 * (d / h - first) / width - 1;
  if (!(std::abs(u) < 1)) return 0;
  constexpr double least_steiner = 0.05; // beyond the focal points of an unresolved rim
  return h * h * tables[kind](u) / std::max(least_steiner, 1 - d * KM + d * d * K);
}

} // namespace lamella
