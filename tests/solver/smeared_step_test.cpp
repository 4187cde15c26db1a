// The profiles that a sharp boundary is smeared with, and the moduli across it.
#include "energy/coefficient.h"

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

const StepProfiles profiles{accurate, of_moments, monotonic};
const Coefficient kappa{1, 5, Profile::compliance}, C{-3, 0.5, Profile::accurate},
    kappa_G{3.6, -1, Profile::moments}, quartic{0, 2, Profile::monotonic};

Univariate course_of(const Coefficient& coefficient, double x) {
  return coefficient.at(profiles.at(x));
}

TEST(Coefficient, IsThatOfThePhasesAwayFromTheBoundary) {
  for (const Coefficient& c : {kappa, C, kappa_G, quartic})
    for (const double x : {-1.001, 1.001}) {
      const Univariate at = course_of(c, x * half_width);
      EXPECT_NEAR(at.f, x < 0 ? c.ld : c.lo, 1e-14);
      EXPECT_EQ(at.d1, 0);
      EXPECT_EQ(at.d2, 0);
      EXPECT_TRUE(c.differs());
    }
  EXPECT_FALSE((Coefficient{2, 2, Profile::compliance}.differs()));
}

TEST(Coefficient, KnowsItsDerivatives) {
  const double e = 1e-5;
  for (const Coefficient& c : {kappa, C, kappa_G, quartic})
    for (double x = -0.95 * half_width; x < half_width; x += 0.1 * half_width) {
      const Univariate at = course_of(c, x), before = course_of(c, x - e),
                       after = course_of(c, x + e);
      EXPECT_NEAR(at.d1, (after.f - before.f) / (2 * e), 1e-4);
      EXPECT_NEAR(at.d2, (after.d1 - before.d1) / (2 * e), 1e-2);
    }
}

TEST(Coefficient, BendsLikeSpringsInARow) {
  for (double x = -half_width; x < half_width; x += 0.1 * half_width) {
    const double H = monotonic.at(x).step;
    EXPECT_NEAR(1 / course_of(kappa, x).f, (1 - H) / kappa.ld + H / kappa.lo, 1e-14);
  }
}

} // namespace
} // namespace lamella
