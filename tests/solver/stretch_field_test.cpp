// What local stretch does to a membrane and to its lipid is the derivative of its energy.
#include "dynamics/stretch_field.h"
#include "levelset/taylor.h"
#include "start_surface.h"

#include <gtest/gtest.h>

namespace lamella {
namespace {

using Eigen::Vector3d;

constexpr double mu = 3, e = 1e-3; // of the difference quotients

double lipid_at(const Vec3& x) {
  return 1 + 0.1 * std::sin(3 * x[0] + 1) * std::cos(2 * x[1] - x[2]);
}
double bump(const Vec3& x) {
  return std::cos(3 * x[0] + 0.3) * std::sin(2.5 * x[1] + 0.7) + 0.4 * std::cos(4 * x[2]);
}

/// A membrane with its lipid, and what is known of both.
struct State : StartSurface {
  StretchField stretch;

  State()
      : StartSurface(ellipsoid({0.6, 0.5, 0.42}), Grid::cube(48, 0.85)),
        stretch(mu, grid, fourier) {
    stretch.c().evolving().fit(at_nodes(grid, lipid_at), 8);
    look();
  }
  void look() {
    measure();
    measure(); // nearest points go by one Newton step at a time
    stretch.c().sample(geometry);
  }
  double energy() const { return stretch.energy(geometry); }
};

/// dE/de where a state changes by e times something.
template <class Change>
double quotient(Change&& change) {
  auto at = [&](double amount) {
    State s;
    change(s, amount);
    s.look();
    return s.energy();
  };
  return (at(e) - at(-e)) / (2 * e);
}

/// Coefficients with given values at the band's nodes: the field itself is a little smoother, which
/// is most of the errors below.
void add(const State& s, LevelSet& to, double factor, std::span<const double> of_entries) {
  for (std::size_t i = 0; i < s.band.size(); i++)
    to.coefficients()[s.band.node()[i]] += factor * of_entries[i];
}

// Lipid moves with the membrane: where it is displaced by u, c_t = c K_M u - u N.grad c at a place.
TEST(Stretch, PullsOnTheMembraneAsItsEnergySays) {
  const State s;
  std::vector<double> F(s.geometry.size(), 0.);
  s.stretch.add_variation(s.geometry, F);
  std::vector<Vector3d> places;
  for (std::size_t i = 0; i < s.geometry.size(); i++) {
    const Vec3 p = s.geometry.point(i);
    places.push_back({p[0], p[1], p[2]});
  }
  LevelSet change(s.grid);
  for (std::size_t i = 0; i < s.grid.size(); i++)
    change.coefficients()[i] = bump(s.grid.position(i));
  const std::vector<Taylor> w = taylor(change, places), c = taylor(s.stretch.c().spline(), places);
  std::vector<double> carried(s.band.size(), 0.);
  double work = 0;
  for (std::size_t i = 0; i < places.size(); i++) {
    const Vec3 n = s.geometry.normal(i);
    const double u = -w[i].value / s.geometry.grad()[i];
    work += s.geometry.weight()[i] * F[i] * u;
    if (i < s.geometry.entry().size())
      carried[s.geometry.entry()[i]] =
          c[i].value * s.geometry.KM()[i] * u - u * c[i].gradient.dot(Vector3d(n[0], n[1], n[2]));
  }
  const double exact = quotient([&](State& varied, double amount) {
    for (std::size_t i = 0; i < s.grid.size(); i++)
      varied.phi.coefficients()[i] += amount * change.coefficients()[i];
    add(s, varied.stretch.c().evolving().spline(), amount, carried);
  });
  EXPECT_GT(std::abs(exact), 0.01);
  EXPECT_NEAR(work, exact, 0.02 * std::abs(exact)); // measured 0.011
}

// With v_s = grad_s sigma_c the energy falls by int v_s^2 dA.
TEST(Stretch, LipidFlowsDownItsEnergy) {
  const State s;
  std::vector<double> rate(s.band.size(), 0.);
  double friction = 0;
  std::vector<Vector3d> places;
  for (std::size_t i = 0; i < s.geometry.size(); i++) {
    const Vec3 p = s.geometry.point(i);
    places.push_back({p[0], p[1], p[2]});
  }
  const std::vector<Taylor> c = taylor(s.stretch.c().spline(), places);
  for (std::size_t i = 0; i < s.geometry.size(); i++) {
    const Vec3 n = s.geometry.normal(i);
    const Vector3d N(n[0], n[1], n[2]), slope = c[i].gradient - c[i].gradient.dot(N) * N;
    const double factor = c[i].value * s.stretch.law().at(c[i].value).d2;
    friction += s.geometry.weight()[i] * factor * factor * slope.squaredNorm();
    if (i < s.geometry.entry().size())
      rate[s.geometry.entry()[i]] = s.stretch.rate(i, s.geometry.KM()[i], 0);
  }
  const double exact = quotient([&](State& varied, double amount) {
    add(s, varied.stretch.c().evolving().spline(), amount, rate);
  });
  EXPECT_GT(friction, 0.01);
  EXPECT_NEAR(-friction, exact, 0.04 * friction); // measured 0.019
}

} // namespace
} // namespace lamella
