// The profiles that a sharp boundary is smeared with, and the moduli across it.
#include "energy/phase_moduli.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace lamella {
namespace {

constexpr double half_width = 0.3;

/// By Simpson's rule.
template <class Function>
double integral(Function&& f, double from, double to, int intervals = 2000) {
  const double step = (to - from) / intervals;
  double sum = 0;
  for (int i = 0; i <= intervals; i++)
    sum += (i == 0 || i == intervals ? 1 : i % 2 ? 4 : 2) * f(from + i * step);
  return sum * step / 3;
}

double moment(const SmearedStep& s, int power) {
  return integral([&](double x) { return std::pow(x, power) * s.at(x).delta; }, -half_width,
                  half_width);
}

/// E |x - y|^power in half-widths, x and y distributed as delta.
double of_distances(const SmearedStep& s, int power) {
  constexpr int n = 400;
  std::vector<double> delta;
  for (int i = 0; i < n; i++)
    delta.push_back(2. / n * half_width * s.at(((2 * i + 1.) / n - 1) * half_width).delta);
  double sum = 0;
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++)
      sum += delta[i] * delta[j] * std::pow(2. / n * std::abs(i - j), power);
  return sum;
}

const SmearedStep accurate = SmearedStep::accurate(half_width),
                  of_moments = SmearedStep::of_moments(half_width),
                  monotonic = SmearedStep::monotonic(half_width),
                  of_line_forces = SmearedStep::of_line_forces(half_width),
                  of_line_couples = SmearedStep::of_line_couples(half_width);

TEST(SmearedStep, GoesFromZeroToOneWithDerivatives) {
  for (const SmearedStep& s : {accurate, of_moments, monotonic, of_line_forces, of_line_couples}) {
    EXPECT_EQ(s.half_width(), half_width);
    EXPECT_NEAR(moment(s, 0), 1, 1e-11);
    EXPECT_DOUBLE_EQ(s.at(0).step, 0.5);
    for (const double x : {-2., -1., 1., 2.}) {
      const SmearedStep::Value v = s.at(x * half_width);
      EXPECT_EQ(v.step, x > 0 ? 1 : 0);
      EXPECT_EQ(v.delta, 0);
      EXPECT_EQ(v.slope, 0);
    }
    for (double x = -0.95 * half_width; x < half_width; x += 0.1 * half_width) {
      const SmearedStep::Value v = s.at(x), mirror = s.at(-x);
      EXPECT_NEAR(v.step, integral([&](double y) { return s.at(y).delta; }, -half_width, x), 1e-10);
      EXPECT_NEAR(v.step + mirror.step, 1, 1e-14);
      EXPECT_NEAR(v.delta, mirror.delta, 1e-13);
      const double e = 1e-5;
      EXPECT_NEAR(v.slope, (s.at(x + e).delta - s.at(x - e).delta) / (2 * e), 1e-5);
    }
    EXPECT_NEAR(s.at(0.999999 * half_width).step, 1, 1e-12) << "no jump at the end";
  }
}

TEST(SmearedStep, OfModuliNeverLeavesThoseOfThePhases) {
  double last = 0;
  for (double x = -half_width; x <= half_width; x += 0.01 * half_width) {
    EXPECT_GE(monotonic.at(x).delta, 0);
    EXPECT_GE(monotonic.at(x).step, last);
    last = monotonic.at(x).step;
  }
  EXPECT_LE(last, 1);
}

/// Energies err by these moments (smeared_step.h).
TEST(SmearedStep, LeavesEnergiesAsASharpBoundaryHasThem) {
  const double h2 = half_width * half_width;
  for (const SmearedStep& s : {accurate, of_moments, of_line_forces, of_line_couples})
    EXPECT_NEAR(moment(s, 2), 0, 1e-12 * h2);
  EXPECT_NEAR(moment(monotonic, 2) / h2, 1. / 11, 1e-10); // of (1 - u^2)^4
  // Measured -2.7e-4, the coefficient 55.6 being rounded, against .12 of the bell; .024, .080, .34.
  EXPECT_NEAR(of_distances(accurate, 3), 0, 5e-4);
  EXPECT_GT(of_distances(monotonic, 3), 0.1);
  EXPECT_LT(std::abs(of_distances(of_moments, 1)), 0.35 * of_distances(accurate, 1));
  EXPECT_LT(of_distances(accurate, 1), 0.25 * of_distances(monotonic, 1));
  EXPECT_NEAR(of_distances(of_line_couples, 1), 0, 1e-4); // 265.6 being rounded
}

// -----------------------------------------------------------------------------------------------
// moduli

const Phase soft{1, -3, 3.6}, stiff{5, 0.5, -1};
const PhaseModuli moduli(soft, stiff, accurate, monotonic, of_moments);

TEST(PhaseModuli, AreThoseOfThePhasesAwayFromTheBoundary) {
  for (const double x : {-1.001, 1.001}) {
    const PhaseModuli::Value v = moduli.at(x * half_width);
    const Phase& phase = x < 0 ? soft : stiff;
    EXPECT_DOUBLE_EQ(v.kappa.f, phase.bending_modulus);
    EXPECT_DOUBLE_EQ(v.C.f, phase.spontaneous_curvature);
    EXPECT_DOUBLE_EQ(v.kappa_G.f, phase.gaussian_modulus);
    for (const auto& c : {v.kappa, v.C, v.kappa_G}) {
      EXPECT_EQ(c.d1, 0);
      EXPECT_EQ(c.d2, 0);
    }
  }
  EXPECT_TRUE(moduli.differ());
  EXPECT_FALSE(PhaseModuli(soft, soft, accurate, monotonic, of_moments).differ());
}

TEST(PhaseModuli, KnowTheirDerivatives) {
  const double e = 1e-5;
  for (double x = -0.95 * half_width; x < half_width; x += 0.1 * half_width) {
    const PhaseModuli::Value v = moduli.at(x), before = moduli.at(x - e), after = moduli.at(x + e);
    auto expect = [&](auto course) {
      const auto& [f, d1, d2] = v.*course;
      EXPECT_NEAR(d1, ((after.*course).f - (before.*course).f) / (2 * e), 1e-4);
      EXPECT_NEAR(d2, ((after.*course).d1 - (before.*course).d1) / (2 * e), 1e-2);
    };
    expect(&PhaseModuli::Value::kappa);
    expect(&PhaseModuli::Value::C);
    expect(&PhaseModuli::Value::kappa_G);
  }
}

TEST(PhaseModuli, BendLikeSpringsInARow) {
  for (double x = -half_width; x < half_width; x += 0.1 * half_width) {
    const double H = monotonic.at(x).step, kappa = moduli.at(x).kappa.f;
    EXPECT_NEAR(1 / kappa, (1 - H) / soft.bending_modulus + H / stiff.bending_modulus, 1e-14);
  }
}

} // namespace
} // namespace lamella
