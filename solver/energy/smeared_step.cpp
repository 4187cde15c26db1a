#include "energy/smeared_step.h"

#include <Eigen/LU>

namespace lamella {

namespace {

constexpr int terms = SmearedStep::terms;

/// Coefficients of (1 - u^2)^power in powers of u^2.
std::array<double, terms> bell(int power) {
  std::array<double, terms> c{1};
  for (int n = 0; n < power; n++)
    for (int j = terms - 1; j > 0; j--) c[j] -= c[j - 1];
  return c;
}

/// int_{-1}^{1} u^(2 m) bell(u) du
double moment(const std::array<double, terms>& bell, int m) {
  double sum = 0;
  for (int j = 0; j < terms; j++) sum += 2 * bell[j] / (2 * (j + m) + 1);
  return sum;
}

} // namespace

/// delta(u) = (1 - u^2)^power (a + b u^2 + quartic u^4) with int delta = 1, int u^2 delta = 0.
SmearedStep::SmearedStep(double half_width, int power, double quartic) : half_width_(half_width) {
  const std::array<double, terms> w = bell(power);
  Eigen::Matrix2d m;
  m << moment(w, 0), moment(w, 1), moment(w, 1), moment(w, 2);
  const Eigen::Vector2d ab =
      m.inverse() * Eigen::Vector2d(1 - quartic * moment(w, 2), -quartic * moment(w, 3));
  for (int j = 0; j < terms; j++)
    even_[j] = ab[0] * w[j] + (j > 0 ? ab[1] * w[j - 1] : 0) + (j > 1 ? quartic * w[j - 2] : 0);
}

SmearedStep::SmearedStep(double half_width, const std::array<double, terms>& even)
    : half_width_(half_width), even_(even) {}

SmearedStep SmearedStep::accurate(double half_width) { return {half_width, 4, 55.6}; }

SmearedStep SmearedStep::of_moments(double half_width) { return {half_width, 4, 95}; }

SmearedStep SmearedStep::of_line_forces(double half_width) { return {half_width, 7, 100}; }

SmearedStep SmearedStep::of_line_couples(double half_width) { return {half_width, 7, 265.6}; }

SmearedStep SmearedStep::monotonic(double half_width) {
  std::array<double, terms> w = bell(4);
  const double mass = moment(w, 0);
  for (double& c : w) c /= mass;
  return {half_width, w};
}

SmearedStep::Value SmearedStep::at(double x) const {
  const double u = x / half_width_, v = u * u;
  if (u >= 1) return {1, 0, 0, 0};
  if (u <= -1) return {0, 0, 0, 0};
  double step = 0, delta = 0, slope = 0, bend = 0;
  for (int j = terms - 1; j >= 0; j--) {
    step = step * v + even_[j] / (2 * j + 1);
    delta = delta * v + even_[j];
    if (j > 0) slope = slope * v + 2 * j * even_[j];
    if (j > 0) bend = bend * v + 2 * j * (2 * j - 1) * even_[j];
  }
  const double w = half_width_;
  return {0.5 + u * step, delta / w, u * slope / (w * w), bend / (w * w * w)};
}

} // namespace lamella
