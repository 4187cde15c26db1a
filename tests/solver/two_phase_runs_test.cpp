// Whole runs of two phases against exact axisymmetric equilibria, and what happens to domains.
#include "energy/smeared_step.h"
#include "levelset/domains.h"
#include "runs.h"
#include "scene/builtin.h"

#include <Eigen/Geometry>

namespace lamella {
namespace {

using Kind = Event::Kind;

/// A built-in scene on another grid, where validation would ask for a finer one, run until it
/// rests.
Scene on_grid(const char* name, int nodes, double end_time) {
  Scene scene = builtin_scene(name);
  scene.nodes = {nodes, nodes, nodes};
  scene.end_time = end_time;
  return scene;
}

Scene bulged_cap(int nodes) { return on_grid("fig9", nodes, 0.06); }
Scene equal_halves(int nodes) { return on_grid("fig11_v0.8_kl10", nodes, 0.1); }

/// Scale invariance at rest: 3 P V over 2 sum sigma A + kappa_l L.
double virial_ratio(const Scene& scene, const Measures& m) {
  const PhaseMeasures& p = *m.phases;
  return 3 * m.P * m.volume /
         (2 * (p.sigma_Ld * p.area_Ld + p.sigma_Lo * p.area_Lo) +
          scene.line.tension * p.line_length);
}

/// Of the steps after the volume has arrived.
double largest_rise_after(double ramp_end, const std::vector<Measures>& history) {
  std::vector<Measures> later;
  for (const Measures& m : history)
    if (m.time > ramp_end * (1 + 1e-9)) later.push_back(m);
  return largest_rise(later);
}

void expect_held(const std::vector<Measures>& history) {
  EXPECT_LE(worst_drift(history), 1e-5);
  for (const Measures& m : history) EXPECT_LT(std::abs(m.phases->area_Ld_drift), 1e-5) << m.time;
}

/// Measured only once, before psi is the distance, the energy of the start is 705.8 and that of the
/// first step 764.4. Now 764.8, and 763.2 after 1e-11: 2.2e-3, of which why is not known.
TEST(PhaseBoundary, IsSettledWhereTheRunStarts) {
  Scene scene = scene_of({.kind = ShapeKind::prolate, .reduced_volume = 0.8}, 32, 1e-11);
  scene.domains = {.kind = DomainsKind::cap, .area_fraction = 0.4, .direction = {1, 0.5, 0}};
  scene.line.tension = 30;
  scene.lo.bending_modulus = 47;
  const std::vector<Measures> history = run(scene);
  EXPECT_NEAR(history.front().energy, history.back().energy, 5e-3 * history.back().energy);
}

/// On a grid on which the boundary once moved back in every step.
TEST(PhaseBoundary, RelaxesAtTheSamePaceInShortAndInLongSteps) {
  Scene scene = scene_of(oblate(0.73, 0.83), 32, 3e-4);
  scene.half_width = 4. / 3;
  scene.domains = {.kind = DomainsKind::cap, .area_fraction = 0.44, .direction = {-1, -1, 1}};
  scene.line.tension = 18;
  scene.lo.bending_modulus = 1.6;
  std::vector<double> lost;
  for (const double tolerance : {5e-3, 2e-4}) { // 27 and 50 steps
    scene.numerics.tolerance = tolerance;
    const std::vector<Measures> history = run(scene);
    lost.push_back(history.front().phases->line_energy - history.back().phases->line_energy);
  }
  EXPECT_NEAR(lost[1] / lost[0], 1, 0.02); // measured .9955; .93 when it moved
}

// -----------------------------------------------------------------------------------------------
// equilibria: tests/reference/two_phase_axisymmetric.py

// Measured at 40^3, 48^3, 56^3, 64^3: E off by .087, .050, .033, .022; line energy by .30, .19,
// .12, .08; r by .0016, .0010, .0007, .0004; 3 P V by -.24 %, -.17 %, -.13 %, -.09 %. At rest steps
// raise the energy by up to 3e-4 of 125.
TEST(BulgedCap, ConvergesToTheExactEquilibrium) {
  constexpr double E = 125.5287;
  std::vector<double> off;
  for (const int nodes : {40, 56}) {
    const Scene scene = bulged_cap(nodes);
    const std::vector<Measures> history = run(scene);
    const Measures& end = history.back();
    off.push_back(end.energy - E);
    expect_held(history);
    EXPECT_LE(largest_rise_after(1e-3, history), 1e-3);
    EXPECT_NEAR(virial_ratio(scene, end), 1, 5e-3);
    EXPECT_NEAR(end.phases->area_Ld, 0.2 * 4 * M_PI * 0.98 * 0.98, 1e-4);
    EXPECT_NEAR(end.reduced_volume, 0.9, 1e-4);
    EXPECT_EQ(end.components, 1);
    EXPECT_EQ(end.phases->domains_Ld, 1);
    EXPECT_EQ(end.phases->domains_Lo, 1);
    if (nodes == 40) continue;
    EXPECT_NEAR(end.phases->line_energy, 90.0825, 0.2);
    EXPECT_NEAR(end.phases->line_radius, 0.47790, 1e-3);
    EXPECT_NEAR(end.phases->bending_energy_Ld, 14.1569, 0.05);
    EXPECT_NEAR(end.phases->bending_energy_Lo, 21.2893, 0.1);
    EXPECT_NEAR(end.P, 92.8715, 1);
    EXPECT_NEAR(end.phases->sigma_Ld, 19.383, 0.3);
    EXPECT_NEAR(end.phases->sigma_Lo, 41.685, 0.4);
  }
  EXPECT_LT(std::abs(off[1]), 0.05);
  EXPECT_GT(std::log(off[0] / off[1]) / std::log(56. / 40), 2); // measured 2.9
}

TEST(BulgedCap, DoesNotDependOnPlaceAndDirection) {
  Scene along = bulged_cap(48), turned = along, shifted = along;
  turned.domains.direction = {1, 2, 3};
  shifted.shape.center = {0.03, -0.02, 0.01};
  const double energy = run(along).back().energy;
  // Measured 1.1e-2 and 1e-3, of 125.6: what the grid itself is off by is 5e-2.
  EXPECT_NEAR(run(turned).back().energy, energy, 0.025);
  EXPECT_NEAR(run(shifted).back().energy, energy, 0.025);
}

TEST(BulgedCap, FindsItsShapeWhereOnePhasePrefersToBend) {
  Scene scene = bulged_cap(48);
  scene.ld.spontaneous_curvature = -3;
  const Measures end = run(scene).back();
  // Measured + .036, 2.154, .4814; at 64^3 + .017, 2.179, .4809.
  EXPECT_NEAR(end.energy, 114.50731, 0.08);
  EXPECT_NEAR(end.phases->bending_energy_Ld, 2.2074, 0.07);
  EXPECT_NEAR(end.phases->line_radius, 0.48049, 1.2e-3);
}

TEST(BulgedCap, FeelsTheNormalCurvatureOfItsBoundary) {
  Scene scene = bulged_cap(48);
  scene.line.normal_modulus = 2;
  const Measures end = run(scene).back();
  EXPECT_NEAR(end.energy, 113.59191, 0.12); // measured + .077
  EXPECT_NEAR(end.phases->line_energy, 90.27155 - 12.08238, 0.4);
}

TEST(BulgedCap, FeelsTheSquareOfTheGeodesicCurvature) {
  Scene scene = bulged_cap(48);
  scene.line.geodesic_square_modulus = 1;
  const Measures end = run(scene).back();
  EXPECT_NEAR(end.energy, 126.57022, 0.09); // measured + .066, of which .050 without the modulus
  EXPECT_NEAR(*end.terms[Term::geodesic_square], 0.64946, 0.04); // + .023
  EXPECT_NEAR(end.phases->line_radius, 0.47998, 2e-3);
}

/// Case C14: kappa_g, kappa_n and both squares.
TEST(BulgedCap, RestsInTheExactEquilibriumOfMixedLineModuli) {
  Scene scene = bulged_cap(48);
  scene.domains.area_fraction = 0.3;
  scene.volume.ramp.targets = {0.85};
  scene.line = {.tension = 20,
                .geodesic_modulus = 0.5,
                .normal_modulus = -1,
                .geodesic_square_modulus = 0.5,
                .normal_square_modulus = 0.4,
                .drag = 1};
  const std::vector<Measures> history = run(scene);
  const Measures& end = history.back();
  EXPECT_LE(largest_rise_after(2e-3, history), 1e-3);
  EXPECT_NEAR(end.energy, 108.61714, 0.06); // measured + .039
  EXPECT_NEAR(*end.terms[Term::geodesic_square], 0.73954, 0.01);
  EXPECT_NEAR(*end.terms[Term::normal_square], 4.49365, 0.02);
  EXPECT_NEAR(*end.terms[Term::normal], 5.90639, 0.01);
  EXPECT_NEAR(end.phases->line_radius, 0.49423, 1.5e-3);
}

TEST(EqualHalves, RestInTheExactEquilibrium) {
  const Scene scene = equal_halves(40);
  const std::vector<Measures> history = run(scene);
  const Measures& end = history.back();
  EXPECT_NEAR(end.energy, 67.48288, 0.03); // measured at 48^3 + .005
  EXPECT_NEAR(end.phases->line_radius, 0.49355, 2e-3);
  EXPECT_NEAR(end.phases->sigma_Ld, end.phases->sigma_Lo, 0.02); // the phases do not differ
  EXPECT_NEAR(virial_ratio(scene, end), 1, 0.01);
  expect_held(history);
}

/// The couple at the boundary: without it the neck leaves the boundary the other way.
TEST(EqualHalves, AreMadeUnequalByTheirGaussianModuli) {
  Scene scene = equal_halves(48);
  scene.ld.gaussian_modulus = 2;
  const Measures end = run(scene).back();
  EXPECT_NEAR(end.energy, 76.89835, 0.15);                     // measured + .080
  EXPECT_NEAR(end.terms.value(Term::gaussian), 6.87288, 0.05); // 6.872
  EXPECT_NEAR(end.phases->line_radius, 0.50815, 5e-3);         // .5106
  EXPECT_NEAR(end.phases->bending_energy_Ld, 18.7290, 0.25);   // 18.604
}

// -----------------------------------------------------------------------------------------------
// events

TEST(Fission, PartsThePhasesAtTheirBoundary) {
  const Outcome run = follow(on_grid("fig11_v0.7_kl10", 40, 0.02));
  const Measures& end = run.history.back();
  EXPECT_EQ(count(run.events, Kind::fission), 1);
  EXPECT_EQ(topology_changes(run.events), 1);
  EXPECT_EQ(end.components, 2);
  EXPECT_EQ(end.genus, 0);
  EXPECT_EQ(end.phases->domains_Ld, 1);
  EXPECT_EQ(end.phases->domains_Lo, 1);
  EXPECT_EQ(end.phases->line_length, 0) << "no boundary is left";
  EXPECT_NEAR(end.phases->area_Ld, end.phases->area_Lo, 1e-3);
  // Two equal oblates of reduced volume .7 sqrt 2, as the neck left them.
  const double parts = interpolated(reference("single_phase_oblate.csv"), 0.7 * std::sqrt(2), 2);
  EXPECT_NEAR(end.energy, parts, 5e-3); // measured 8e-4
  for (const Event& e : run.events)
    if (e.kind == Kind::fission) {
      EXPECT_LT(e.energy_after, e.energy_before);
      EXPECT_LT(std::hypot(e.place[0], e.place[1], e.place[2]), 0.05);
    }
}

/// So many degrees from the z axis, towards x and towards y.
Vec3 direction(double x, double y) {
  const double a = x * M_PI / 180, b = y * M_PI / 180;
  return {std::sin(a), std::sin(b), std::cos(a) * std::cos(b)};
}

/// Caps, which may overlap, on a sphere that loses volume, at 40^3.
Scene with_caps(std::vector<Vec3> directions, double end_time) {
  Scene scene = scene_of(sphere(0.98), 40, end_time);
  scene.half_width = 1.4;
  scene.domains.kind = DomainsKind::caps;
  scene.domains.directions = std::move(directions);
  scene.domains.half_angle = 12;
  scene.line.tension = 20;
  scene.volume.constraint = Constraint::ramped;
  scene.volume.ramp = {{0.93}, {0}, 50};
  return scene;
}

/// A long and a short domain on opposite sides.
Scene unequal_caps() { return with_caps({direction(-12, 0), direction(12, 0), {0, 0, -1}}, 1e-3); }

TEST(Domains, ThatBecomeRoundSideBySideMerge) {
  const Outcome run =
      follow(with_caps({direction(-18, 14.5), direction(0, 14.5), direction(18, 14.5),
                        direction(-18, -14.5), direction(0, -14.5), direction(18, -14.5)},
                       8e-4));
  EXPECT_EQ(run.history.front().phases->domains_Ld, 2);
  EXPECT_EQ(run.history.back().phases->domains_Ld, 1);
  EXPECT_EQ(topology_changes(run.events), 0);
  ASSERT_EQ(count(run.events, Kind::domains_merged), 1);
  const Event& merged = *std::ranges::find(run.events, Kind::domains_merged, &Event::kind);
  EXPECT_EQ(merged.domains_before, 2);
  EXPECT_EQ(merged.domains_after, 1);
  EXPECT_NEAR(merged.place[1], 0, 0.1) << "between them; their middles are 0.25 from there";
  expect_held(run.history);
}

/// Area of Ld on either side of z = 0, and the lipid on the membrane.
struct Sides {
  double above = 0, below = 0, lipid = 0;
};

Sides sides(const Frame& frame) {
  StartSurface s(frame.phi, frame.grid);
  LevelSet psi(frame.grid), c(frame.grid);
  psi.fit(frame.fields.at("psi"), s.fourier, 60);
  const std::vector<double> lipid =
      frame.has("c") ? frame.fields.at("c") : std::vector<double>(frame.grid.size(), 1.0);
  c.fit(lipid, s.fourier, 60);
  std::vector<Eigen::Vector3d> places;
  for (std::size_t i = 0; i < s.geometry.size(); i++) {
    const Vec3 p = s.geometry.point(i);
    places.push_back({p[0], p[1], p[2]});
  }
  const std::vector<Taylor> at_psi = taylor(psi, places), at_c = taylor(c, places);
  const auto step = SmearedStep::accurate(4 * frame.grid.spacing);
  Sides sum;
  for (std::size_t i = 0; i < places.size(); i++) {
    const double w = s.geometry.weight()[i];
    (places[i][2] > 0 ? sum.above : sum.below) += w * (1 - step.at(at_psi[i].value).step);
    sum.lipid += w * at_c[i].value;
  }
  return sum;
}

TEST(Domains, CoarsenWhereLipidFlowsFreely) {
  const Outcome run = follow(unequal_caps());
  EXPECT_EQ(run.history.front().phases->domains_Ld, 2);
  EXPECT_EQ(run.history.back().phases->domains_Ld, 1);
  ASSERT_EQ(count(run.events, Kind::domain_vanished), 1);
  const Event& gone = *std::ranges::find(run.events, Kind::domain_vanished, &Event::kind);
  EXPECT_LT(gone.place[2], 0) << "the short one";
  expect_held(run.history);
}

/// The twelve caps of fig13a, turned about an axis that is none of the lattice's.
Scene twelve_caps(double angle) {
  Scene scene = on_grid("fig13a", 40, 0.014);
  const Eigen::AngleAxisd turn(angle, Eigen::Vector3d(0.3, 0.5, 0.8).normalized());
  for (Vec3& d : scene.domains.directions) {
    const Eigen::Vector3d turned = turn * Eigen::Vector3d(d[0], d[1], d[2]);
    d = {turned[0], turned[1], turned[2]};
  }
  return scene;
}

// No cap differs from another, so that the lattice decides which ones go. What hardly depends on
// how they lie on it is that they coarsen, and when. Measured: the first one is gone at 0.01013 and
// 0.01168.
TEST(Domains, TwelveEqualCapsCoarsenAtOnePaceWhicheverWayTheyLie) {
  std::vector<double> first;
  for (const double angle : {0., 1.}) {
    const Scene scene = twelve_caps(angle);
    Simulation sim(scene);
    std::vector<Measures> history{sim.measures()};
    EXPECT_EQ(history.front().phases->domains_Ld, 12);
    while (sim.time() < scene.end_time && count(sim.events(), Kind::domain_vanished) == 0) {
      sim.step(scene.end_time);
      history.push_back(sim.measures());
    }
    ASSERT_EQ(count(sim.events(), Kind::domain_vanished), 1);
    first.push_back(sim.time());
    EXPECT_GE(history.back().phases->domains_Ld, 8);
    EXPECT_EQ(count(sim.events(), Kind::domains_merged), 0);
    expect_held(history);
  }
  EXPECT_NEAR(first[1] / first[0], 1, 0.2);
}

// Lipid that hardly stretches cannot get from one domain into another. Measured: the long domain
// +.07 %, the short one -.8 % (this quadrature is another); where mu = 0 +31 % and -54 %.
TEST(Domains, KeepTheirAreasWhereTheMembraneHardlyStretches) {
  Scene scene = unequal_caps();
  scene.domains.half_angle = 18; // what keeps its area needs a rim that the grid resolves
  scene.stretch.modulus = 1000;
  const Sides before = sides(Simulation(scene).frame());
  const Outcome run = follow(scene);
  const Sides after = sides(run.end);
  EXPECT_EQ(run.history.back().phases->domains_Ld, 2);
  EXPECT_NEAR(after.above / before.above, 1, 0.005);
  EXPECT_NEAR(after.below / before.below, 1, 0.02);
  EXPECT_NEAR(after.lipid / before.lipid, 1, 6e-4); // measured 3e-4, by another quadrature
  for (const Measures& m : run.history) {
    EXPECT_GT(m.stretch->least, 0.95); // .977 .. 1.003
    EXPECT_LT(m.stretch->greatest, 1.05);
  }
  expect_held(run.history);
}

} // namespace
} // namespace lamella
