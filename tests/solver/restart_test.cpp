#include "runs.h"
#include "scene/builtin.h"
#include "store/history.h"

#include <bit>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <memory>

// A simulation that goes on from a stored state is the one that was not interrupted, to the last
// bit.
namespace lamella {
namespace {

/// A row of the history, as bits.
std::vector<std::uint64_t> bits(Measures m) {
  std::vector<std::uint64_t> all;
  for (const Field& field : row_of(m))
    all.push_back(
        std::bit_cast<std::uint64_t>(std::visit([](auto* x) { return double(*x); }, field.value)));
  return all;
}

bool same_bits(std::span<const double> a, std::span<const double> b) {
  return std::ranges::equal(a, b, {}, std::bit_cast<std::uint64_t, double>,
                            std::bit_cast<std::uint64_t, double>);
}

/// Follows a scene, restarting copies where `interrupt` says so, which must go the same way for so
/// many steps. Returns how many there were.
int restarts_that_agree(const Scene& scene, int steps,
                        const std::function<bool(const Simulation& now, int step)>& interrupt) {
  Simulation sim(scene);
  std::vector<std::pair<std::unique_ptr<Simulation>, int>> copies; // each with its last step
  int made = 0;
  for (int step = 1; step <= steps && sim.time() < scene.end_time; step++) {
    sim.step(scene.end_time);
    for (auto& [copy, last] : copies) {
      copy->step(scene.end_time);
      EXPECT_EQ(bits(copy->measures()), bits(sim.measures())) << "step " << step;
      EXPECT_TRUE(std::ranges::equal(copy->events(), sim.events())) << "step " << step;
    }
    std::erase_if(copies, [&](const auto& copy) { return copy.second == step; });
    if (!interrupt(sim, step)) continue;
    made++;
    copies.emplace_back(std::make_unique<Simulation>(scene, sim.state()), step + 8);
    const Frame a = sim.frame(), b = copies.back().first->frame();
    EXPECT_TRUE(same_bits(a.phi, b.phi)) << "step " << step;
    EXPECT_EQ(a.fields.size(), b.fields.size());
    for (const auto& [name, values] : a.fields)
      EXPECT_TRUE(same_bits(values, b.field(name))) << name << ", step " << step;
  }
  return made;
}

auto at_steps(std::vector<int> steps) {
  return [=](const Simulation&, int step) { return std::ranges::count(steps, step) > 0; };
}

/// After each event that changes the topology or moves the box, and two steps later.
auto after_events() {
  return [seen = std::size_t(0), soon = 0](const Simulation& sim, int) mutable {
    const auto events = sim.events().subspan(seen);
    seen = sim.events().size();
    if (soon > 0) soon--;
    const bool now = std::ranges::any_of(events, [](const Event& e) {
      return e.changes_topology() || e.kind == Event::Kind::recentred;
    });
    if (now) soon = 3;
    return now || soon == 1;
  };
}

Scene builtin_on(const char* name, int nodes) {
  Scene scene = builtin_scene(name);
  scene.nodes = {nodes, nodes, nodes};
  return scene;
}

TEST(Restart, IsExactWithOnePhase) {
  const Scene scene = builtin_on("fig3_oblate", 32);
  EXPECT_EQ(restarts_that_agree(scene, 50, at_steps({1, 2, 3, 7, 18, 33})), 6);
}

TEST(Restart, IsExactWithRampsAndAHeldAreaDifference) {
  const Scene scene = builtin_on("fig8b", 32);
  EXPECT_GT(restarts_that_agree(scene, 40, at_steps({1, 5, 14, 26})), 3);
}

TEST(Restart, IsExactWithTwoPhases) {
  const Scene scene = builtin_on("fig9", 40);
  EXPECT_EQ(restarts_that_agree(scene, 30, at_steps({1, 6, 19})), 3);
}

TEST(Restart, IsExactWithAllLineModuli) {
  Scene scene = builtin_on("fig9", 40);
  scene.line = {.tension = 30,
                .geodesic_modulus = 0.5,
                .torsion_modulus = 0.5,
                .normal_modulus = -1,
                .geodesic_square_modulus = 0.5,
                .torsion_square_modulus = 0.3,
                .normal_square_modulus = 0.4};
  EXPECT_EQ(restarts_that_agree(scene, 30, at_steps({1, 6, 19})), 3);
}

TEST(Restart, IsExactWithStretch) {
  Scene scene = builtin_on("fig9", 32);
  scene.stretch.modulus = 1000;
  EXPECT_EQ(restarts_that_agree(scene, 24, at_steps({1, 4, 13})), 3);
}

TEST(Restart, IsExactWithDomainsThatAreHeld) {
  Scene scene = builtin_on("fig15a", 40);
  EXPECT_EQ(restarts_that_agree(scene, 16, at_steps({1, 4, 9})), 3);
}

TEST(Restart, IsExactWithMaterialFields) {
  Scene scene = scene_of(ellipsoid({0.65, 0.5, 0.3}), 32, 2e-4);
  scene.membrane.density = "0.3*k*KM^2 + 40*m^2";
  scene.fields = {{"k", "1 + x", Carried::value}, {"m", "1 + 0.5*z", Carried::amount}};
  EXPECT_EQ(restarts_that_agree(scene, 20, at_steps({1, 6, 11})), 3);
}

TEST(Restart, IsExactWithFilms) {
  Scene scene = scene_of(ellipsoid({0.65, 0.5, 0.3}), 32, 2e-4);
  scene.contact.disjoining_pressure = 3000; // its range by default
  EXPECT_EQ(restarts_that_agree(scene, 20, at_steps({1, 6, 11})), 3);
}

TEST(Restart, IsExactUnderAPressureAndAMultiplier) {
  Scene scene = scene_of(ellipsoid({0.65, 0.5, 0.3}), 32, 2e-4);
  scene.volume.constraint = Constraint::free;
  scene.volume.pressure = -60;
  scene.area_difference.multiplier = 4;
  EXPECT_EQ(restarts_that_agree(scene, 20, at_steps({1, 6, 11})), 3);
}

TEST(Restart, IsExactWhereSpontaneousCurvatureSetsIn) {
  Scene scene = builtin_on("fig9", 40);
  scene.line.drag = 0; // by default
  scene.ld.spontaneous_curvature = -3;
  scene.curvature_start_time = 1e-5;
  const auto around_it = [&, done = 0](const Simulation& sim, int) mutable {
    return sim.time() > 0.8 * scene.curvature_start_time && done++ < 6;
  };
  EXPECT_EQ(restarts_that_agree(scene, 40, around_it), 6);
}

TEST(Restart, IsExactRightAfterANeckParted) {
  Scene scene = builtin_on("fig6b", 48);
  scene.end_time = 6e-5;
  EXPECT_GE(restarts_that_agree(scene, 400, after_events()), 2);
}

TEST(Restart, IsExactWithVesiclesThatKeepTheirOwn) {
  Scene scene = builtin_on("fig6b", 48);
  scene.volume.of = scene.area.of = Of::each;
  scene.end_time = 5e-5;
  EXPECT_GE(restarts_that_agree(scene, 400, after_events()), 2);
}

TEST(Restart, IsExactRightAfterTheBoxMoved) {
  Scene scene = scene_of(ellipsoid({0.6, 0.4, 0.2}), 40, 3e-4);
  scene.membrane.spontaneous_curvature = -15; // arms grow
  scene.shape.center = {4 * 2. / 40, 0, 0};
  EXPECT_GE(restarts_that_agree(scene, 60, after_events()), 2);
}

} // namespace
} // namespace lamella
