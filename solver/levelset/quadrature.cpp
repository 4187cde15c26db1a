#include "levelset/quadrature.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lamella {

namespace {

// A little under pi times the width of the kernel, where its transform's first side lobe begins.
constexpr double beta_of(double width) { return 2.95 * width; }

/// What scales exp(beta (sqrt(1 - u^2) - 1)) on u in [-1, 1] to int = 1 over d/h, for widths of 2
/// to 4.8 spacings: linear between 1024 intervals, to 1e-6. Continuous in the width, which
/// curvatures decide: with the nearest of 90 widths the area jumped by 1e-4 where necks part, and
/// corrections that should have led to the constraints went to and fro.
class Scales {
public:
  Scales() {
    for (int i = 0; i <= intervals; i++) scale_[i] = scale(narrowest + i * step);
  }
  double operator[](double width) const {
    const double r = (width - narrowest) / step;
    const int i = std::clamp(int(r), 0, intervals - 1);
    return scale_[i] + (r - i) * (scale_[i + 1] - scale_[i]);
  }

private:
  static constexpr int intervals = 1024;
  static constexpr double narrowest = 2, widest = 4.8, step = (widest - narrowest) / intervals;

  /// With u = sin t, by Simpson's rule.
  static double scale(double width) {
    constexpr int parts = 64;
    constexpr double dt = 0.5 * std::numbers::pi / parts;
    double sum = 0;
    for (int i = 0; i <= parts; i++) {
      const double c = std::cos(i * dt);
      sum += (i == 0 || i == parts ? 1
              : i % 2 == 0         ? 2
                                   : 4) *
             c * std::exp(beta_of(width) * (c - 1));
    }
    return 3 / (dt * sum * width);
  }
  double scale_[intervals + 1];
};

} // namespace

QuadratureKernel QuadratureKernel::reaching(double bend) const {
  constexpr double share = 0.67;
  return {-std::clamp(share / std::max(bend, 1e-300), least, -begin), end, least};
}

double QuadratureKernel::weight(double d, double KM, double K, double h) const {
  static const Scales scales;
  constexpr double focal_share = 1.05, nearest = 1; // of the way to a focal point, where it ends
  const double root = std::sqrt(std::max(0.0, 0.25 * KM * KM - K));
  auto reach = [=](double most, double curvature) {
    return curvature * h * most > focal_share ? std::max(nearest, focal_share / (curvature * h))
                                              : most;
  };
  const double last = reach(end, 0.5 * KM + root), first = -reach(-begin, root - 0.5 * KM);
  const double width = last - first, u = 2 * (d / h - first) / width - 1;
  if (!(std::abs(u) < 1)) return 0;
  constexpr double least_steiner = 0.05; // beyond the focal points of an unresolved rim
  const double profile = std::exp(beta_of(width) * (std::sqrt(1 - u * u) - 1));
  return h * h * scales[width] * profile / std::max(least_steiner, 1 - d * KM + d * d * K);
}

} // namespace lamella
