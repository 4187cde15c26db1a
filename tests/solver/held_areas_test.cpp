// The parts of the phases whose areas are held, and what their tensions do.
#include "dynamics/held_areas.h"
#include "energy/smeared_step.h"
#include "geometry/boundary_feet.h"
#include "two_phases.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace lamella {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double R = 0.6, north = 0.9, south = 1.7; // polar angles of the boundaries

/// A sphere with a cap of Lo, a ring of Ld around it, and the rest, Lo too.
struct Ring : TwoPhases {
  Ring(double north, double south)
      : TwoPhases(
            sphere(R),
            [=](const Vector3d& x) {
              const double angle = std::acos(std::clamp(x[2] / x.norm(), -1., 1.));
              return R * std::max(north - angle, angle - south);
            },
            56) {
    feet.find(boundary, phi, band, 8 * grid.spacing);
    const auto step = SmearedStep::accurate(4 * grid.spacing);
    for (std::size_t i = 0; i < geometry.size(); i++) {
      const bool own = i < geometry.entry().size();
      const BoundaryFeet::Foot foot = own ? feet[geometry.entry()[i]] : BoundaryFeet::Foot{};
      point.push_back(foot.at);
      const Vec3 p = geometry.point(i);
      const double angle = std::acos(p[2] / R);
      share.push_back(1 - step.at(R * std::max(north - angle, angle - south)).step);
    }
  }
  HeldAreas::Integrals find(HeldAreas& held, std::span<const double> F = {}) const {
    held.find(band, domains_of(band, psi.nodal()), boundary, one);
    held.sample(grid, geometry, point, one);
    const std::vector<double> speed(boundary.points().size(), 1);
    return held.integrate(geometry, share, F, boundary, speed, 1, one);
  }

  Components one{grid, false};
  BoundaryFeet feet;
  std::vector<int> point;
  std::vector<double> share;
};

constexpr double ring_area = 2 * M_PI * R * R, cap_area = ring_area;
double length(double angle) { return 2 * M_PI * R * std::sin(angle); }

/// The ring and the cap, wherever they stand.
std::pair<int, int> ring_and_cap(const HeldAreas::Integrals& sum) {
  const int ring = sum.area[0] > sum.area[1] ? 0 : 1;
  return {ring, 1 - ring};
}

TEST(HeldAreas, AreAllOfLdWhereLipidFlowsFreely) {
  const Ring s(north, south);
  HeldAreas held(false, true, s.grid.spacing);
  const HeldAreas::Integrals sum = s.find(held);
  ASSERT_EQ(held.size(), 1u);
  const double exact = ring_area * (std::cos(north) - std::cos(south));
  EXPECT_NEAR(sum.area[0] / exact, 1, 1e-3);
  EXPECT_NEAR(sum.line_gram(0, 0) / (length(north) + length(south)), 1, 1e-4);
  EXPECT_NEAR(sum.variation[0] / (length(north) + length(south)), 1, 1e-4); // F = 0, a speed of 1
  EXPECT_NEAR(sum.with_surface(0, 0) / (-2 / R * exact), 1, 1e-3);
}

TEST(HeldAreas, AreThoseOfAllDomainsButTheRestWhereItDoesNot) {
  const Ring s(north, south);
  HeldAreas held(true, true, s.grid.spacing);
  const std::vector<double> F(s.geometry.size(), 1);
  const HeldAreas::Integrals sum = s.find(held, F);
  ASSERT_EQ(held.size(), 2u);
  EXPECT_EQ(sum.variation.size(), 2);
  const auto [ring, cap] = ring_and_cap(sum);
  const double of_ring = ring_area * (std::cos(north) - std::cos(south)),
               of_cap = cap_area * (1 - std::cos(north));
  EXPECT_NEAR(sum.area[ring] / of_ring, 1, 1e-3);
  EXPECT_NEAR(sum.area[cap] / of_cap, 1, 1e-3);
  EXPECT_NEAR(sum.line_gram(ring, ring) / (length(north) + length(south)), 1, 1e-4);
  EXPECT_NEAR(sum.line_gram(cap, cap) / length(north), 1, 1e-4);
  EXPECT_NEAR(sum.line_gram(ring, cap) / -length(north), 1, 1e-4);
  const double KM = -2 / R;
  EXPECT_NEAR(sum.variation[ring], KM * of_ring + length(north) + length(south), 1e-2);
  EXPECT_NEAR(sum.variation[cap], KM * of_cap - length(north), 1e-2);
  EXPECT_NEAR((sum.gram - sum.gram.transpose()).norm(), 0, 1e-12);
}

// q K_M of a tension in the ring alone: the membrane and both boundaries feel it, the cap and the
// rest do not.
TEST(HeldAreas, TensionsPullWhereTheirPartIs) {
  const Ring s(north, south);
  HeldAreas held(true, true, s.grid.spacing);
  const HeldAreas::Integrals sum = s.find(held);
  const auto [ring, cap] = ring_and_cap(sum);
  VectorXd tensions(2);
  tensions[ring] = 5;
  tensions[cap] = 2;
  held.set_tensions(tensions, sum, s.share, 4 * M_PI * R * R);
  for (std::size_t i = 0; i < s.geometry.size(); i++) {
    const double angle = std::acos(s.geometry.point(i)[2] / R);
    const double Lo = angle < 0.5 * (north + south) ? 2 : 0;
    EXPECT_NEAR(held.tension()[i], s.share[i] * 5 + (1 - s.share[i]) * Lo, 1e-12);
  }
  for (std::size_t j = 0; j < s.boundary.points().size(); j++)
    EXPECT_EQ(held.jump()[j], s.boundary.points()[j].x[2] > 0.3 ? 3 : 5);
  EXPECT_EQ(held.greatest(), 5);
  EXPECT_DOUBLE_EQ(held.mean_Ld(), 5);
  EXPECT_NEAR(held.mean_Lo(), 2 * sum.area[cap] / (4 * M_PI * R * R - sum.area[ring]), 1e-12);
  for (const double u : held.shift()) EXPECT_NEAR(u, 0, 1e-12);
}

// A cap that lost area asks the circle around it back, and that circle alone.
TEST(HeldAreas, BoundariesAreAskedBackToWhereAreasWere) {
  HeldAreas held(true, true, Grid::cube(56, 1).spacing);
  auto look = [&](const Ring& s) {
    const HeldAreas::Integrals sum = s.find(held);
    held.set_tensions(VectorXd::Zero(2), sum, s.share, 4 * M_PI * R * R);
  };
  look(Ring(north, south));
  const double lost = 5e-4;
  const Ring later(north - lost / R, south);
  look(later);
  for (std::size_t j = 0; j < later.boundary.points().size(); j++) {
    const BoundaryPoint& p = later.boundary.points()[j];
    // n points to Lo: at the cap's circle to the pole.
    EXPECT_NEAR(held.shift()[j], p.x[2] > 0.3 ? -lost : 0, 0.03 * lost);
  }
}

} // namespace
} // namespace lamella
