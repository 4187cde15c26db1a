// Frames on finer lattices and in smaller boxes.
#include "fields/refine.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lamella {
namespace {

using testing::ElementsAre;

template <class Phi>
Frame frame_of(Phi&& phi, const Grid& grid) {
  Frame frame{.grid = grid, .phi = std::vector<double>(grid.size())};
  for (std::size_t n = 0; n < grid.size(); ++n) frame.phi[n] = phi(grid.position(n));
  return frame;
}

TEST(Refine, IsExactForPolynomialsOfDegreeFive) {
  const auto polynomial = [](const Vec3& p) {
    return std::pow(p[0], 5) - 2 * std::pow(p[1], 4) * p[2] + p[0] * p[1] * p[2] + 0.5;
  };
  Frame coarse = frame_of(polynomial, Grid::cube(12, 1));
  for (const double phi : coarse.phi) coarse.fields["psi"].push_back(1 - phi);
  const Frame fine = refine(coarse, 3);
  const Grid& grid = fine.grid;
  EXPECT_EQ(grid, Grid::cube(36, 1));
  for (std::size_t n = 0; n < grid.size(); ++n) {
    const Vec3 p = grid.position(n);
    if (std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}) > 0.5) continue; // near the ends
    EXPECT_NEAR(fine.phi[n], polynomial(p), 1e-12);
    EXPECT_NEAR(fine.fields.at("psi")[n], 1 - polynomial(p), 1e-12);
  }
}

TEST(Crop, KeepsTheMembraneInItsPlace) {
  const auto sphere = [](const Vec3& p) { return std::hypot(p[0] - 0.2, p[1], p[2]) - 0.3; };
  Frame whole = frame_of(sphere, Grid::cube(48, 1));
  for (const double phi : whole.phi) whole.fields["psi"].push_back(1 - phi);
  const Frame part = crop(whole, 0.1);
  EXPECT_THAT(part.grid.nodes, ElementsAre(30, 20, 20));
  for (std::size_t n = 0; n < part.grid.size(); ++n) {
    const Vec3 p = part.grid.position(n);
    EXPECT_NEAR(part.phi[n], sphere(p), 1e-12);
    EXPECT_NEAR(part.fields.at("psi")[n], 1 - part.phi[n], 1e-12);
  }
}

} // namespace
} // namespace lamella
