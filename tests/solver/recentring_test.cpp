// The box follows the vesicle by whole cells.
#include "runs.h"

namespace lamella {
namespace {

using Kind = Event::Kind;

/// Of the inside, where ParaView shows it.
Vec3 centre_of(const Frame& frame) {
  const StartSurface s(frame.phi, frame.grid);
  Vec3 sum{};
  double volume = 0;
  for (std::size_t i = 0; i < s.geometry.size(); i++) {
    const Vec3 p = s.geometry.point(i), n = s.geometry.normal(i);
    for (int d = 0; d < 3; d++) {
      sum[d] += 0.5 * s.geometry.weight()[i] * p[d] * p[d] * n[d];
      volume += s.geometry.weight()[i] * p[d] * n[d] / 3;
    }
  }
  for (int d = 0; d < 3; d++) sum[d] = sum[d] / volume + frame.cells[d] * frame.grid.spacing;
  return sum;
}

TEST(Recentring, LeavesPhysicsAlone) {
  const int nodes = 40;
  const double h = 2. / nodes;
  const Scene central = scene_of(oblate(0.58, 0.8), nodes, 4e-4);
  Scene aside = central;
  aside.shape.center = {5 * h, 0, -2 * h}; // 3.4 spacings from a side
  const Outcome a = follow(central);
  Outcome b = follow(aside);
  ASSERT_GE(count(b.events, Kind::recentred), 1);
  EXPECT_EQ(count(a.events, Kind::recentred), 0);
  EXPECT_EQ(b.end.cells, (std::array{5, 0, -2}));
  const Measures &m = a.history.back(), &n = b.history.back();
  EXPECT_NEAR(n.energy / m.energy, 1, 1e-6); // measured 3e-8
  EXPECT_NEAR(n.P / m.P, 1, 1e-4);
  EXPECT_LE(largest_rise(b.history), 1e-9);
  EXPECT_LE(worst_drift(b.history), 1e-5);
  const Vec3 centre = centre_of(b.end);
  for (int d = 0; d < 3; d++) EXPECT_NEAR(centre[d], aside.shape.center[d], 0.01 * h);
}

TEST(Recentring, FollowsGrowth) {
  const int nodes = 40;
  const double h = 2. / nodes;
  Scene central = scene_of(ellipsoid({0.6, 0.4, 0.2}), nodes, 3e-4);
  central.membrane.spontaneous_curvature = -15; // arms grow
  Scene aside = central;
  aside.shape.center = {4 * h, 0, 0};
  const Outcome a = follow(central), b = follow(aside);
  ASSERT_GE(count(b.events, Kind::recentred), 1);
  EXPECT_GT(std::ranges::find(b.events, Kind::recentred, &Event::kind)->time, 1e-6);
  // Measured 2e-4: starts differ by 3e-6, and growing arms amplify that; 4e-4 before the box moves.
  EXPECT_NEAR(b.history.back().energy / a.history.back().energy, 1, 2e-3);
  EXPECT_LE(worst_drift(b.history), 1e-5);
  EXPECT_NEAR(centre_of(b.end)[0], aside.shape.center[0], 0.02 * h);
}

TEST(Recentring, GivesPlacesOfEventsInSpace) {
  const double h = 1. / 16;
  Scene scene = scene_of(oblate(0.8, 0.5), 40, 7e-4); // its middle becomes thin at 6e-4
  scene.half_width = 1.25;
  scene.shape.center = {4 * h, 0, -5 * h};
  const Outcome run = follow(scene);
  EXPECT_EQ(count(run.events, Kind::recentred), 1);
  const auto thin = std::ranges::find(run.events, Kind::thin_inside, &Event::kind);
  ASSERT_NE(thin, run.events.end());
  for (int d = 0; d < 3; d++) EXPECT_NEAR(thin->place[d], scene.shape.center[d], 0.1 * h);
}

} // namespace
} // namespace lamella
