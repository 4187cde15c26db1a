// The terms of the energy, each for itself.
#include "dynamics/simulation.h"
#include "runs.h"

#include <numbers>

namespace lamella {
namespace {

const double pi = std::numbers::pi;

/// A cap of Ld, a quarter of a sphere, with all there is.
Scene sphere_with_everything(double radius) {
  Scene scene = scene_of({.kind = ShapeKind::sphere, .radius = radius}, 48, 1e-4);
  scene.domains = {.kind = DomainsKind::cap, .area_fraction = 0.25};
  scene.ld = {2, -1, 3};
  scene.lo = {4, 0, 1};
  scene.line = {
      .tension = 5, .geodesic_modulus = 0.5, .torsion_modulus = 0.25, .normal_modulus = 2};
  scene.stretch.modulus = 10;
  scene.volume.constraint = Constraint::free;
  scene.volume.pressure = -7;
  scene.area_difference.multiplier = 1.5;
  scene.contact.disjoining_pressure = 100;
  return scene;
}

TEST(EnergyTerms, OfSquaresOnASphereAreExact) {
  Scene scene = sphere_with_everything(0.6);
  scene.line = {.torsion_modulus = 0,
                .geodesic_square_modulus = 0.5,
                .torsion_square_modulus = 2,
                .normal_square_modulus = 0.25};
  const double L = 2 * pi * 0.6 * std::sqrt(0.75), kg = -0.5 / (0.6 * std::sqrt(0.75));
  const EnergyTerms terms = Simulation(scene).measures().terms;
  EXPECT_NEAR(*terms[Term::geodesic_square], 0.5 * kg * kg * L, 1e-3);
  EXPECT_NEAR(*terms[Term::normal_square], 0.25 / (0.6 * 0.6) * L, 1e-3);
  EXPECT_NEAR(*terms[Term::torsion_square], 0, 1e-6);
}

TEST(EnergyTerms, OfACapOnASphereAreExact) {
  const double r = 0.6, cosine = 0.5, sine = std::sqrt(0.75), L = 2 * pi * r * sine;
  const Measures m = Simulation(sphere_with_everything(r)).measures();
  EXPECT_NEAR(*m.terms[Term::line_tension], 5 * L, 5e-3 * L);
  EXPECT_NEAR(*m.terms[Term::geodesic], 0.5 * -cosine / (r * sine) * L, 5e-3);
  EXPECT_NEAR(*m.terms[Term::normal], 2 * -1 / r * L, 2e-2);
  EXPECT_NEAR(*m.terms[Term::torsion], 0, 1e-3);
  EXPECT_NEAR(*m.terms[Term::gaussian], 4 * pi * (0.25 * 3 + 0.75 * 1), 1e-2);
  EXPECT_NEAR(*m.terms[Term::pressure], 7 * 4. / 3 * pi * r * r * r, 1e-3);
  EXPECT_NEAR(*m.terms[Term::area_difference], 0.5 * 1.5 * -8 * pi * r, 2e-2);
  EXPECT_NEAR(m.energy, m.terms.sum(), 1e-12 * std::abs(m.energy));
}

TEST(EnergyTerms, AreThoseOfTheScene) {
  const auto has = [](Scene scene) {
    const Measures m = Simulation(scene).measures();
    return std::array{m.terms[Term::pressure].has_value(),
                      m.terms[Term::area_difference].has_value(), m.terms[Term::film].has_value()};
  };
  using Terms = std::array<bool, 3>;
  Scene scene = scene_of({.kind = ShapeKind::oblate, .reduced_volume = 0.8}, 32, 1e-4);
  EXPECT_EQ(has(scene), (Terms{false, false, false}));
  scene.contact.disjoining_pressure = 100;
  EXPECT_EQ(has(scene), (Terms{false, false, true}));
  scene.area_difference.multiplier = 1;
  scene.volume.constraint = Constraint::free;
  scene.volume.pressure = -3;
  EXPECT_EQ(has(scene), (Terms{true, true, true}));
  scene.area_difference.constraint = Constraint::fixed;
  EXPECT_EQ(has(scene), (Terms{true, false, true})) << "held, not under the multiplier";
}

TEST(EnergyTerms, OfALineAreThoseWithAModulus) {
  Scene scene = scene_of({.kind = ShapeKind::oblate, .reduced_volume = 0.9}, 32, 1e-4);
  scene.domains.kind = DomainsKind::cap;
  scene.line.normal_modulus = 1;
  const Measures m = Simulation(scene).measures();
  EXPECT_TRUE(m.terms[Term::normal]);
  for (const Term other : {Term::line_tension, Term::geodesic, Term::torsion})
    EXPECT_FALSE(m.terms[other]);
  EXPECT_EQ(m.phases->line_energy, *m.terms[Term::normal]);
}

} // namespace
} // namespace lamella
