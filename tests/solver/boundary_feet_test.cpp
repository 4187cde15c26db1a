// The distance from the phase boundary along the membrane, open pieces of it, and domains.
#include "geometry/boundary_feet.h"
#include "levelset/domains.h"
#include "two_phases.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace lamella {
namespace {

using Eigen::Vector3d;

constexpr double R = 0.6;
const Vector3d tilted = Vector3d(1, 2, -1.5).normalized();

BoundaryFeet feet_of(const TwoPhases& s, double reach) {
  BoundaryFeet feet;
  feet.find(s.boundary, s.phi, s.band, reach * s.grid.spacing);
  return feet;
}

Vector3d nearest_point(const TwoPhases& s, std::size_t entry) {
  const ConstPoints p = s.band.points();
  return {p.x[entry], p.y[entry], p.z[entry]};
}

struct FootErrors {
  double distance = 0, place = 0; ///< largest, in spacings
  int count = 0;
};

/// Feet on the circle of latitude at an angle from the tilted axis of a sphere.
FootErrors cap_errors(double angle, int nodes) {
  const TwoPhases s(
      sphere(R), [&](const Vector3d& x) { return R * std::cos(angle) - tilted.dot(x); }, nodes);
  const double h = s.grid.spacing;
  const BoundaryFeet feet = feet_of(s, 8);
  EXPECT_EQ(feet.size(), s.band.size());
  FootErrors e;
  for (std::size_t i = 0; i < feet.size(); i++) {
    const Vector3d x = nearest_point(s, i).normalized();
    const double theta = std::acos(std::clamp(tilted.dot(x), -1., 1.));
    const double exact = R * (theta - angle); // P- is around the axis
    if (std::abs(exact) > 5 * h) continue;
    EXPECT_TRUE(feet[i].exists());
    if (!feet[i].exists()) break;
    const Vector3d on = R * (std::cos(angle) * tilted +
                             std::sin(angle) * (x - tilted.dot(x) * tilted).normalized());
    const std::vector<Vector3d> places = s.places();
    e.distance = std::max(e.distance, std::abs(feet[i].distance - exact) / h);
    e.place = std::max(e.place, (feet[i].share * places[feet[i].next] +
                                 (1 - feet[i].share) * places[feet[i].at] - on)
                                        .norm() /
                                    h);
    e.count++;
  }
  EXPECT_GT(e.count, 100);
  return e;
}

// Measured at 32^3 and 64^3: distances 4e-3 and 1.7e-4 spacings, where the chord would be off by
// 1.4e-2 at 64^3; places .1 and 3.4e-3.
TEST(BoundaryFeet, KnowTheDistanceAlongASphere) {
  for (const double angle : {0.5, 1., 0.5 * M_PI, 2.2})
    for (const int nodes : {32, 64}) {
      const FootErrors e = cap_errors(angle, nodes);
      EXPECT_LT(e.distance, nodes == 32 ? 8e-3 : 4e-4) << angle;
      EXPECT_LT(e.place, nodes == 32 ? 0.2 : 0.01) << angle;
    }
}

TEST(BoundaryFeet, EndAtTheirReach) {
  const TwoPhases s(
      sphere(R), [](const Vector3d& x) { return -x[2]; }, 48);
  const double h = s.grid.spacing;
  const BoundaryFeet feet = feet_of(s, 3);
  for (std::size_t i = 0; i < feet.size(); i++) {
    const double distance = R * std::asin(std::clamp(nearest_point(s, i)[2] / R, -1., 1.));
    if (std::abs(distance) < 2.9 * h || std::abs(distance) > 3.2 * h) {
      EXPECT_EQ(feet[i].exists(), std::abs(distance) < 3 * h);
    }
    if (feet[i].exists()) {
      EXPECT_EQ(feet[i].distance<0, distance> 0); // P- is above
    }
  }
}

TEST(BoundaryFeet, AreNoneWithoutABoundary) {
  const TwoPhases s(
      sphere(R), [](const Vector3d& x) { return 0.9 - x[2]; }, 32);
  const BoundaryFeet feet = feet_of(s, 8);
  for (std::size_t i = 0; i < feet.size(); i++) EXPECT_FALSE(feet[i].exists());
}

// -----------------------------------------------------------------------------------------------
// neighbours, open pieces

TEST(PhaseBoundary, KnowsTheNeighboursOfItsPoints) {
  const TwoPhases s(
      sphere(R), [](const Vector3d& x) { return x[2] * x[2] - 0.09; }, 48);
  ASSERT_EQ(s.boundary.curves(), 2u);
  EXPECT_EQ(s.boundary.open_pieces(), 0u);
  const std::span<const BoundaryPoint> p = s.boundary.points();
  for (int i = 0; i < int(p.size()); i++) {
    const auto [before, after] = s.boundary.neighbours(i);
    EXPECT_EQ(s.boundary.neighbours(after).first, i);
    EXPECT_EQ(s.boundary.neighbours(before).second, i);
    EXPECT_LT((p[after].x - p[i].x).norm(), 0.6 * s.grid.spacing);
    EXPECT_GT((p[after].x - p[before].x).dot(p[i].t), 0);
  }
}

/// {x y = 0} on a sphere crosses itself at the poles: what lies between them can be followed.
TEST(PhaseBoundary, KeepsThePiecesOfACurveThatCrossesItself) {
  const TwoPhases s(
      sphere(R), [](const Vector3d& x) { return x[0] * x[1]; }, 48);
  EXPECT_EQ(s.boundary.curves(), 0u);
  EXPECT_FALSE(s.boundary.unresolved().empty());
  ASSERT_GE(s.boundary.open_pieces(), 4u);
  const std::span<const BoundaryPoint> p = s.boundary.points();
  int ends = 0;
  for (int i = 0; i < int(p.size()); i++) {
    EXPECT_NEAR(p[i].x.norm(), R, 1e-3);
    EXPECT_NEAR(p[i].x[0] * p[i].x[1], 0, 1e-4);
    const auto [before, after] = s.boundary.neighbours(i);
    ends += (before == i) + (after == i);
    EXPECT_TRUE(after == i || s.boundary.neighbours(after).first == i);
    EXPECT_TRUE(before == i || s.boundary.neighbours(before).second == i);
    EXPECT_LE((p[after].x - p[i].x).norm(), 1.1 * s.grid.spacing);
  }
  EXPECT_EQ(ends, 2 * int(s.boundary.open_pieces()));
  // Rounding decides at the poles how far a piece goes on, by a step of half a spacing at most.
  // Measured: shorter by 7e-4 with the baseline kernels, by 0.0236 with those for AVX2.
  EXPECT_LE(s.boundary.length(), 4 * M_PI * R + 1e-3);
  EXPECT_GE(s.boundary.length(), 4 * M_PI * R - 0.5 * s.grid.spacing * ends);
}

// -----------------------------------------------------------------------------------------------
// domains

std::vector<Domain> domains_on_sphere(const TwoPhases::Function& psi, int nodes) {
  const TwoPhases s(sphere(R), psi, nodes);
  return domains_of(s.band, s.psi.nodal()).domains;
}

/// Least angle from some directions, less a half angle.
TwoPhases::Function caps(std::vector<Vector3d> axes, double half_angle) {
  return [=](const Vector3d& x) {
    double nearest = M_PI;
    for (const Vector3d& a : axes)
      nearest = std::min(nearest, std::acos(std::clamp(a.dot(x.normalized()), -1., 1.)));
    return R * (nearest - half_angle);
  };
}

TEST(DomainsOf, OneCapAreTwo) {
  const double half_angle = 0.8;
  const std::vector<Domain> d = domains_on_sphere(caps({tilted}, half_angle), 48);
  ASSERT_EQ(d.size(), 2u);
  const Domain &ld = d[d[0].is_Ld ? 0 : 1], &lo = d[d[0].is_Ld ? 1 : 0];
  EXPECT_TRUE(ld.is_Ld);
  EXPECT_FALSE(lo.is_Ld);
  const double exact = 2 * M_PI * R * R * (1 - std::cos(half_angle));
  EXPECT_NEAR(ld.area / exact, 1, 0.05);                          // measured 3e-3
  EXPECT_NEAR((ld.area + lo.area) / (4 * M_PI * R * R), 1, 0.05); // 1e-2
  const Vector3d center(ld.center[0], ld.center[1], ld.center[2]);
  EXPECT_LT((center - center.dot(tilted) * tilted).norm(), 0.02);
  EXPECT_GT(center.dot(tilted), R * std::cos(half_angle));
}

TEST(DomainsOf, TwelveCapsAreTwelveAndTheRest) {
  std::vector<Vector3d> axes; // middles of the edges of a cube
  for (int a = 0; a < 3; a++)
    for (const double u : {-1, 1})
      for (const double v : {-1, 1}) {
        Vector3d x = Vector3d::Zero();
        x[a] = u;
        x[(a + 1) % 3] = v;
        axes.push_back(x.normalized());
      }
  const std::vector<Domain> d = domains_on_sphere(caps(axes, 0.3), 48);
  EXPECT_EQ(d.size(), 13u);
  EXPECT_EQ(std::ranges::count(d, true, &Domain::is_Ld), 12);
}

TEST(DomainsOf, APhaseAloneIsOne) {
  const std::vector<Domain> d = domains_on_sphere([](const Vector3d&) { return 0.5; }, 32);
  ASSERT_EQ(d.size(), 1u);
  EXPECT_FALSE(d[0].is_Ld);
}

TEST(DomainsOf, AStripePartsTheRestInTwo) {
  const std::vector<Domain> d =
      domains_on_sphere([](const Vector3d& x) { return 2 * (x[2] * x[2] - 0.02); }, 48);
  EXPECT_EQ(std::ranges::count(d, true, &Domain::is_Ld), 1);
  EXPECT_EQ(std::ranges::count(d, false, &Domain::is_Ld), 2);
}

} // namespace
} // namespace lamella
