// What is held, led somewhere, or free: multipliers, ramps, equilibria under given multipliers.
#include "runs.h"
#include "scene/shapes.h"

namespace lamella {
namespace {

constexpr int V = 0, A = 1, M = 2; // volume, area, int K_M dA

Scene scene_with(Constraint volume, Constraint area_difference) {
  Scene scene;
  scene.volume.constraint = volume;
  scene.volume.pressure = -37;
  scene.area_difference.constraint = area_difference;
  scene.area_difference.multiplier = 5;
  scene.volume.ramp.targets = {0.8};
  scene.area_difference.ramp.targets = {1.1};
  return scene;
}

// -----------------------------------------------------------------------------------------------
// multipliers

TEST(Multipliers, GiveTheRatesAskedFor) {
  const StartSurface s(moved(ellipsoid({0.7, 0.4, 0.25}), {0.01, -0.02, 0.005}, 25),
                       Grid::cube(48, 1));
  const SurfaceGeometry& g = s.geometry;
  std::vector<double> F(g.size());
  SurfaceEnergy(SurfaceModuli{1.3, -2}).find_forces(g, {}, {}, F);
  const SurfaceIntegrals integrals = integrate(g, {F});
  const Eigen::Vector4d asked{0.7, -1.9, 2.3, 0};
  for (const Constraint volume : {Constraint::fixed, Constraint::ramped, Constraint::free})
    for (const Constraint difference : {Constraint::fixed, Constraint::ramped, Constraint::free})
      for (const double factor : {0., 1.}) {
        const Constraints constraints(scene_with(volume, difference));
        const Quantities rate = factor * asked;
        const Eigen::VectorXd m = constraints.multipliers(integrals.gram.topLeftCorner<3, 3>(),
                                                          integrals.variation, rate);
        Eigen::Vector4d found = Eigen::Vector4d::Zero();
        double scale = 0; // int |v| dA
        for (std::size_t i = 0; i < g.size(); i++) {
          const double KM = g.KM()[i], K = g.K()[i], w = g.weight()[i];
          const double v = -F[i] + m[0] + m[1] * KM + m[2] * K;
          found += w * v * Eigen::Vector4d(1, -KM, -2 * K, 0);
          scale += w * std::abs(v);
        }
        EXPECT_EQ(constraints.is_held(V), volume != Constraint::free);
        EXPECT_TRUE(constraints.is_held(A));
        EXPECT_EQ(constraints.is_held(M), difference != Constraint::free);
        // Measured 4e-6: the solution is damped by what direction the three almost share.
        for (const int i : constraints.held()) EXPECT_NEAR(found[i], rate(i), 1e-5 * scale) << i;
        EXPECT_TRUE(volume != Constraint::free || m[V] == -37);
        EXPECT_TRUE(difference != Constraint::free || m[M] == 5);
      }
}

// -----------------------------------------------------------------------------------------------
// ramps

struct Leg {
  double time, reduced_volume, area_difference;
  bool turns; // something begins or ends here
};

/// The volume goes from 0.9 to 0.8 at once; the area difference from 1.05 towards 1.25 at 0.01, but
/// turns round on its way, at 0.03, where it is 1.15, and ends at 1.
Scene ramped_scene() {
  Scene scene = scene_with(Constraint::ramped, Constraint::ramped);
  scene.volume.ramp = {{0.8}, {0}, 10};
  scene.area_difference.ramp = {{1.25, 1}, {0.01, 0.03}, 5};
  return scene;
}

const Leg legs[] = {{0, 0.9, 1.05, true},      {0.004, 0.86, 1.05, false}, {0.01, 0.8, 1.05, true},
                    {0.012, 0.8, 1.06, false}, {0.03, 0.8, 1.15, true},    {0.04, 0.8, 1.1, false},
                    {0.06, 0.8, 1, true},      {1, 0.8, 1, false}};

constexpr double radius = 0.7; // of the sphere with the vesicle's area
constexpr double volume_unit = 4 * M_PI / 3 * radius * radius * radius,
                 difference_unit = -8 * M_PI * radius;

Quantities with(double reduced_volume, double area_difference) {
  return Eigen::Vector4d(volume_unit * reduced_volume, 4 * M_PI * radius * radius,
                         difference_unit * area_difference, 0);
}

Constraints started(const Scene& scene) {
  Constraints constraints(scene);
  constraints.begin(with(0.9, 1.05));
  return constraints;
}

TEST(Ramps, LeaveTheAreaDifferenceFreeUntilItSetsOut) {
  Constraints constraints = started(ramped_scene());
  EXPECT_FALSE(constraints.is_held(M));
  EXPECT_FALSE(constraints.set_out(0.005, with(0.85, 1.06)));
  EXPECT_FALSE(constraints.is_held(M));
  EXPECT_TRUE(constraints.set_out(0.01, with(0.8, 1.07))) << "from what it has become";
  EXPECT_TRUE(constraints.is_held(M));
  EXPECT_FALSE(constraints.set_out(0.01, with(0.8, 1.07))) << "only once";
  EXPECT_NEAR(constraints.target(0.01)(M) / difference_unit, 1.07, 1e-12);
  EXPECT_NEAR(constraints.target(0.012)(M) / difference_unit, 1.08, 1e-12);
}

Constraints under_way(const Scene& scene) {
  Constraints constraints = started(scene);
  constraints.set_out(0.01, with(0.8, 1.05));
  return constraints;
}

TEST(Ramps, LeadTargetsAtTheirRate) {
  const Constraints constraints = under_way(ramped_scene());
  for (const Leg& leg : legs) {
    const Quantities target = constraints.target(leg.time);
    EXPECT_NEAR(target(V) / volume_unit, leg.reduced_volume, 1e-12) << leg.time;
    EXPECT_NEAR(target(A), 4 * M_PI * radius * radius, 1e-12);
    EXPECT_NEAR(target(M) / difference_unit, leg.area_difference, 1e-12) << leg.time;
  }
}

TEST(Ramps, RateIsTheDerivativeOfTheTarget) {
  const Constraints constraints = under_way(ramped_scene());
  for (const double t : {0.001, 0.009, 0.011, 0.02, 0.029, 0.031, 0.05, 0.059, 0.07}) {
    const double e = 1e-5;
    const Quantities slope = (constraints.target(t + e) - constraints.target(t - e)) / (2 * e);
    EXPECT_LT((constraints.rate(t) - slope).norm(), 1e-6 * (1 + slope.norm())) << t;
  }
}

TEST(Ramps, AreUnderWayUntilTheLastTargetIsReached) {
  const Constraints constraints = under_way(ramped_scene());
  EXPECT_TRUE(constraints.ramping(0));
  EXPECT_TRUE(constraints.ramping(0.0599));
  EXPECT_FALSE(constraints.ramping(0.0601));
  Scene later = ramped_scene();
  later.area_difference.ramp.start_times = {0.5, 0.6};
  EXPECT_TRUE(started(later).ramping(0.3)) << "has yet to set out";
  EXPECT_FALSE(started(scene_with(Constraint::fixed, Constraint::fixed)).ramping(0));
}

TEST(Ramps, StepsLandOnEveryTurn) {
  Constraints constraints = started(ramped_scene());
  std::vector<double> turns;
  double t = 0;
  for (int steps = 0; t < 0.06 && steps < 10000; steps++) {
    const double step = constraints.longest_step(t);
    ASSERT_GT(step, 0);
    const Quantities change = constraints.target(t + step) - constraints.target(t);
    EXPECT_TRUE(!constraints.is_held(M) || std::abs(change(M) / difference_unit) <= 2.501e-3)
        << "in small bits";
    t += step;
    constraints.set_out(t, with(0.8, 1.05));
    if (constraints.turns_at(t)) turns.push_back(t);
  }
  for (const Leg& leg : legs) {
    const bool landed =
        std::ranges::any_of(turns, [&](double x) { return std::abs(x - leg.time) < 1e-12; });
    EXPECT_EQ(landed, leg.turns && leg.time > 0) << leg.time;
  }
  EXPECT_EQ(constraints.longest_step(0.1), std::numeric_limits<double>::infinity());
}

TEST(Ramps, AreFollowedByTheMembrane) {
  const double begin = 1e-3, rate = 5, goal = 1.06;
  Scene scene = scene_of(prolate(0.6, 0.9), 40, 5e-3);
  scene.area_difference.constraint = Constraint::ramped;
  scene.area_difference.ramp = {{goal}, {begin}, rate};
  Simulation sim(scene);
  double start = 0, arrival = 0, energy = sim.measures().energy;
  bool arrived = false;
  while (sim.time() < scene.end_time) {
    sim.step(scene.end_time);
    const Measures& m = sim.measures();
    EXPECT_NEAR(m.area_drift, 0, 1e-5);
    EXPECT_NEAR(m.volume_drift, 0, 1e-5);
    if (m.time <= begin) {
      EXPECT_LE(m.energy, energy) << "free until then";
      energy = m.energy;
    }
    if (m.time < begin) continue;
    if (start == 0) {
      EXPECT_EQ(m.time, begin);
      start = m.area_difference;
      arrival = begin + std::abs(goal - start) / rate;
    }
    const double way = std::min(rate * (m.time - begin), std::abs(goal - start));
    EXPECT_NEAR(m.area_difference, start + std::copysign(way, goal - start), 1e-5) << m.time;
    EXPECT_EQ(sim.ramping(), m.time < arrival * (1 - 5e-5)) << m.time;
    // Measured 1.7e-5: setting out begins from a difference 2e-7 off the recorded one, perhaps as
    // |grad phi| is made even in between; that was not looked into.
    arrived = arrived || std::abs(m.time - arrival) < 5e-5 * arrival;
  }
  EXPECT_TRUE(arrived);
}

TEST(Constraints, HoldTheAreaDifferenceOfTheStart) {
  Scene scene = scene_of(oblate(0.6, 0.75), 32, 1e-3);
  scene.area_difference.constraint = Constraint::fixed;
  const std::vector<Measures> history = run(scene);
  for (const Measures& m : history)
    EXPECT_NEAR(m.area_difference / history[0].area_difference, 1, 2e-5) << m.time;
  EXPECT_LE(worst_drift(history), 1e-5);
  EXPECT_LE(largest_rise(history), 1e-9);
  EXPECT_LT(history.back().energy, history.front().energy);
}

TEST(Ramps, LeadTheReducedVolumeToTheEquilibriumThere) {
  Scene scene = scene_of(oblate(0.6, 0.9), 40, 1.2e-2);
  scene.volume.constraint = Constraint::ramped;
  scene.volume.ramp = {{0.75}, {0}, 50};
  const std::vector<Measures> history = run(scene);
  const Measures& end = history.back();
  const auto exact = reference("single_phase_oblate.csv");
  EXPECT_LE(worst_drift(history), 1e-5);
  EXPECT_NEAR(end.reduced_volume, 0.75, 2e-5);
  EXPECT_NEAR(end.int_KM2, interpolated(exact, 0.75, 2), 0.02);
}

// -----------------------------------------------------------------------------------------------
// free quantities

TEST(FreeVolume, ComesToRestWhereItsPressureIsThatOfTheEquilibrium) {
  const double v = 0.65;
  const auto exact = reference("single_phase_oblate.csv");
  Scene scene = scene_of(oblate(0.65, 0.68), 32, 0.1);
  const double R = std::sqrt(exact_area(scene.shape) / (4 * M_PI));
  scene.volume.constraint = Constraint::free;
  scene.volume.pressure = interpolated(exact, v, 3) / (R * R * R);
  const std::vector<Measures> history = run(scene);
  const Measures& end = history.back();
  EXPECT_LE(largest_rise(history), 1e-3)
      << "of bending energy - P V"; // measured 7e-4 of 88, at rest
  EXPECT_NEAR(end.energy, end.terms.value(Term::bending) - scene.volume.pressure * end.volume,
              1e-9);
  EXPECT_EQ(end.P, scene.volume.pressure);
  // The volume is soft, P changes little with it: what is left falls as exp(-43 t).
  EXPECT_NEAR(end.reduced_volume, v, 1.5e-3);
  EXPECT_NEAR(end.int_KM2, interpolated(exact, v, 2), 0.2);
  EXPECT_NEAR(end.sigma * R * R / interpolated(exact, v, 4), 1, 0.01);
}

TEST(FreeAreaDifference, MultiplierActsAsSpontaneousCurvature) {
  // kappa C^2 / 2 int dA and the tension kappa C^2 / 2 are all that they differ by.
  const double C = -6, kappa = 1.5;
  Scene curved = scene_of(oblate(0.6, 0.85), 32, 4e-5);
  curved.membrane.bending_modulus = kappa;
  curved.numerics.max_time_step = 5e-7; // all steps: their control sees the forces without tension
  curved.numerics.tolerance = 1;
  Scene multiplied = curved;
  curved.membrane.spontaneous_curvature = C;
  multiplied.area_difference.multiplier = -2 * kappa * C;
  const std::vector<Measures> a = run(curved), b = run(multiplied);
  ASSERT_EQ(a.size(), b.size());
  double worst[5] = {};
  const double constant = 0.5 * kappa * C * C;
  for (std::size_t i = 0; i < a.size(); i++) {
    const double differences[] = {a[i].time - b[i].time,
                                  a[i].area_difference - b[i].area_difference, a[i].P / b[i].P - 1,
                                  (a[i].sigma + constant) / b[i].sigma - 1,
                                  (a[i].energy - constant * a[i].area) / b[i].energy - 1};
    for (int k = 0; k < 5; k++) worst[k] = std::max(worst[k], std::abs(differences[k]));
  }
  EXPECT_LT(std::ranges::max(worst), 5e-6); // measured 8e-7, of sigma at the first step
  EXPECT_LT(b.back().energy, b.front().energy);
}

TEST(Constraints, PerturbedStartsHaveTheAreaAndVolumeOfTheirShape) {
  Scene scene = scene_of(moved(oblate(0.6, 0.7), {0.01, 0, -0.02}, 12), 48, 1e-5);
  scene.perturbation = {0.02, 0.3, 7, 0};
  const Measures start = Simulation(scene).measures();
  EXPECT_NEAR(start.area / exact_area(scene.shape), 1, 1e-5);
  EXPECT_NEAR(start.volume / exact_volume(scene.shape), 1, 1e-5);
  scene.perturbation.amplitude = 0;
  EXPECT_GT(start.terms.value(Term::bending),
            1.02 * Simulation(scene).measures().terms.value(Term::bending));
}

} // namespace
} // namespace lamella
