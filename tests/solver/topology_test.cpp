// Components and genus of analytic fields.
#include "levelset/topology.h"
#include "start_surface.h"

#include <gtest/gtest.h>

namespace lamella {

void PrintTo(const Topology& t, std::ostream* out) {
  *out << t.components << " components, genus " << t.genus;
}

namespace {

double ball(const Vec3& x, const Vec3& center, double R) {
  return std::hypot(x[0] - center[0], x[1] - center[1], x[2] - center[2]) - R;
}

/// A ring about the z axis.
double ring(const Vec3& x, const Vec3& center, double R, double r) {
  return std::hypot(std::hypot(x[0] - center[0], x[1] - center[1]) - R, x[2] - center[2]) - r;
}

/// Everywhere in the box, whatever part of a field lies across its sides.
template <class Function>
void expect_topology(const Topology& expected, Function&& f) {
  const Grid grid{{40, 32, 24}, 0.05};
  std::vector<double> phi = at_nodes(grid, f);
  for (const std::array<int, 3> cells : {std::array{0, 0, 0}, {19, 0, 0}, {3, 17, 11}}) {
    shift(grid, cells, phi);
    EXPECT_EQ(topology_of(grid, phi), expected) << cells[0];
    EXPECT_EQ(count_components(grid, phi), expected.components);
  }
}

TEST(Topology, OfSpheres) {
  expect_topology({1, 0}, [](const Vec3& x) { return ball(x, {0, 0, 0}, 0.5); });
  expect_topology({2, 0}, [](const Vec3& x) {
    return std::min(ball(x, {-0.5, 0, 0}, 0.4), ball(x, {0.5, 0.1, 0}, 0.3));
  });
  expect_topology({0, 0}, [](const Vec3&) { return 1; });
}

TEST(Topology, OfTori) {
  expect_topology({1, 1}, [](const Vec3& x) { return ring(x, {0, 0, 0}, 0.5, 0.15); });
  expect_topology({1, 2}, [](const Vec3& x) {
    return std::min(ring(x, {-0.4, 0, 0}, 0.35, 0.12), ring(x, {0.4, 0, 0}, 0.35, 0.12));
  });
  expect_topology({2, 2}, [](const Vec3& x) {
    return std::min(ring(x, {-0.5, 0, 0}, 0.3, 0.12), ring(x, {0.5, 0, 0}, 0.3, 0.12));
  });
}

TEST(Topology, OfATorusAndASphereInItsHole) {
  expect_topology({2, 1}, [](const Vec3& x) {
    return std::min(ring(x, {0, 0, 0}, 0.5, 0.15), ball(x, {0, 0, 0}, 0.2));
  });
}

TEST(Topology, OfAShellCountsTheInsideOnce) {
  auto shell = [](const Vec3& x) {
    return std::max(ball(x, {0, 0, 0}, 0.5), 0.25 - std::hypot(x[0], x[1], x[2]));
  };
  expect_topology({1, 0}, shell);
  expect_topology({2, 0}, // a ball in the cavity
                  [&](const Vec3& x) {
                    return std::min(shell(x), ball(x, {0, 0, 0}, 0.12));
                  });
}

/// A ball of the given sign with the nodes (0, 0, 0) and (dx, dy, dz) of the other one inside.
std::vector<double> ball_with_two_nodes(const Grid& grid, double sign, int dx, int dy, int dz) {
  std::vector<double> phi = at_nodes(grid, [&](const Vec3& x) {
    return sign * ball(x, {0, 0, 0}, 0.5);
  });
  const int middle = grid.nx() / 2;
  for (const int i : {0, 1})
    phi[grid.index(middle + i * dx, middle + i * dy, middle + i * dz)] = sign;
  return phi;
}

TEST(Topology, NodesOutsideTouchDiagonallyTheOnesInsideDoNot) {
  const Grid grid = Grid::cube(24, 1);
  for (const auto& [dx, dy, dz] :
       {std::array{1, 0, 0}, {1, 1, 0}, {0, -1, 1}, {1, 1, 1}, {1, -1, 1}}) {
    const bool diagonal = std::abs(dx) + std::abs(dy) + std::abs(dz) > 1;
    EXPECT_EQ(topology_of(grid, ball_with_two_nodes(grid, 1, dx, dy, dz)), (Topology{1, 0}));
    EXPECT_EQ(topology_of(grid, ball_with_two_nodes(grid, -1, dx, dy, dz)).components,
              diagonal ? 3 : 2);
  }
}

TEST(Topology, OfHollowTorusIsTwo) { // an outer and an inner torus bound it
  expect_topology({1, 2}, [](const Vec3& x) {
    return std::max(ring(x, {0, 0, 0}, 0.4, 0.18), -ring(x, {0, 0, 0}, 0.4, 0.08));
  });
}

} // namespace
} // namespace lamella
