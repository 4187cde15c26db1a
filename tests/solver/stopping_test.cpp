// The rules that end a run before its end time.
#include "dynamics/stopping.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lamella {
namespace {

constexpr double dt = 0.01;

/// A vesicle whose energy decays to 1 and whose speed decays to 0, both as exp(-t).
Measures relaxing(int step) {
  Measures m;
  m.time = step * dt;
  m.dt = step == 0 ? 0 : dt;
  m.energy = 1 + std::exp(-m.time);
  m.max_speed = std::exp(-m.time);
  return m;
}

/// The step after which a relaxing vesicle is stopped, or -1.
int stopped_after(const Stop& rules, int ramping_until = 0) {
  Stopping stopping(rules);
  for (int step = 0; step < 2000; step++)
    if (const auto reason = stopping.reason(relaxing(step), 0, step < ramping_until, 0)) {
      EXPECT_EQ(*reason, "settled");
      return step;
    }
  return -1;
}

TEST(Stopping, GoesOnWithoutRules) {
  EXPECT_EQ(stopped_after({}), -1);
  EXPECT_FALSE(Stopping({}).reason(relaxing(1), 100, false, 1e9));
}

TEST(Stopping, SettlesWhereTheEnergyRateHasBeenLowForFiveSteps) {
  Stop rules;
  rules.energy_rate = 0.01;
  const double slope = std::expm1(dt) / dt; // of the chord that ends at t, over exp(-t)
  EXPECT_EQ(stopped_after(rules), int(std::ceil(std::log(slope / 0.01 - 1) / dt)) + 4);
}

TEST(Stopping, SettlesWhereTheMembraneHasBeenSlowForFiveSteps) {
  Stop rules;
  rules.residual_force = 0.1;
  EXPECT_EQ(stopped_after(rules), int(std::ceil(std::log(10) / dt)) + 4);
}

TEST(Stopping, NeedsBothOfTwoRules) {
  Stop rules;
  rules.energy_rate = 0.01;
  const int low_rate = stopped_after(rules);
  rules.residual_force = 1e-3;
  EXPECT_EQ(stopped_after(rules), int(std::ceil(std::log(1000) / dt)) + 4);
  rules.residual_force = 0.5;
  EXPECT_EQ(stopped_after(rules), low_rate);
}

TEST(Stopping, GivesEveryRunFiveSteps) {
  Stop rules;
  rules.energy_rate = rules.residual_force = 1e6;
  EXPECT_EQ(stopped_after(rules), 5);
}

TEST(Stopping, CountsOnlyStepsInSuccession) {
  Stop rules;
  rules.residual_force = 1;
  Stopping stopping(rules);
  Measures m = relaxing(1);
  for (int step = 1; step < 100; step++) {
    m.max_speed = step % 5 == 0 ? 2 : 0.5;
    EXPECT_FALSE(stopping.reason(m, 0, false, 0)) << step;
  }
}

TEST(Stopping, DoesNotSettleWhileConstraintsChange) {
  Stop rules;
  rules.residual_force = 0.1;
  EXPECT_EQ(stopped_after(rules, 1000), 1004);
}

TEST(Stopping, StopsAfterTopologyChangesAndWhenTimeIsUpEvenWhileConstraintsChange) {
  Stop rules;
  rules.topology_changes = 2;
  rules.wall_time = 60;
  Stopping stopping(rules);
  EXPECT_FALSE(stopping.reason(relaxing(1), 1, true, 59.9));
  EXPECT_EQ(stopping.reason(relaxing(2), 2, true, 0), "stopped as asked after 2 topology changes");
  EXPECT_EQ(stopping.reason(relaxing(2), 0, true, 60), "used up its wall-clock budget of 60 s");
  rules.topology_changes = 1;
  EXPECT_EQ(Stopping(rules).reason(relaxing(1), 1, false, 0),
            "stopped as asked after 1 topology change");
}

} // namespace
} // namespace lamella
