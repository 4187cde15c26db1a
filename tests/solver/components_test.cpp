// Several vesicles: which is which, what each keeps, what is handed on.
#include "dynamics/components.h"
#include "parallel.h"
#include "runs.h"
#include "scene/builtin.h"
#include "store/history.h"

#include <numbers>

namespace lamella {
namespace {

using std::numbers::pi;

double ball(const Vec3& x, const Vec3& center, double R) {
  return std::hypot(x[0] - center[0], x[1] - center[1], x[2] - center[2]) - R;
}

double shell(const Vec3& x, double inner, double outer) {
  return std::max(ball(x, {}, outer), -ball(x, {}, inner));
}

/// A ring about the z axis.
double ring(const Vec3& x, double R, double r) {
  return std::hypot(std::hypot(x[0], x[1]) - R, x[2]) - r;
}

// -----------------------------------------------------------------------------------------------
// which is which

/// The vesicles of a membrane, and to which each sample and band entry belongs.
struct Found : StartSurface {
  template <class Function>
  Found(int nodes, Function&& f)
      : StartSurface(at_nodes(Grid::cube(nodes, 1), f), Grid::cube(nodes, 1)) {
    components.follow(phi.nodal());
    components.find_entries(band);
    components.find_samples(geometry);
  }
  SurfaceIntegrals integrals(int component) const {
    return integrate(geometry, {}, components.samples(component));
  }
  Components components{grid, true};
};

TEST(Components, OfTwoBallsHaveTheirOwnVolumesAndAreas) {
  for (const double gap : {0.3, 0.1, 0.07}) { // at 48^3 down to 1.7 spacings
    const Vec3 small{0, 0, 0.3 + gap}, large{0, 0, -0.4};
    const Found s(
        48, [&](const Vec3& x) { return std::min(ball(x, large, 0.4), ball(x, small, 0.3)); });
    ASSERT_EQ(s.components.count(), 2);
    for (std::size_t i = 0; i < s.geometry.size(); i++)
      EXPECT_EQ(s.components.of_sample(i), s.geometry.point(i)[2] > 0.5 * gap);
    for (std::size_t n = 0; n < s.band.size(); n++)
      EXPECT_EQ(s.components.of_entry(n), s.band.points().z[n] > 0.5 * gap);
    for (const auto& [k, R] : {std::pair{0, 0.4}, {1, 0.3}}) {
      const SurfaceIntegrals sums = s.integrals(k);
      EXPECT_NEAR(sums.volume / (4 * pi / 3 * R * R * R), 1, 2e-3) << gap;
      EXPECT_NEAR(sums.area() / (4 * pi * R * R), 1, 2e-3) << gap;
    }
  }
}

TEST(Components, TakeInTheirInnerSheets) {
  const Found s(64, [](const Vec3& x) { return std::min(shell(x, 0.5, 0.75), ball(x, {}, 0.25)); });
  ASSERT_EQ(s.components.count(), 2);
  for (std::size_t i = 0; i < s.geometry.size(); i++) {
    const Vec3 p = s.geometry.point(i);
    EXPECT_EQ(s.components.of_sample(i), std::hypot(p[0], p[1], p[2]) < 0.4);
  }
  EXPECT_NEAR(s.integrals(0).area() / (4 * pi * (0.75 * 0.75 + 0.5 * 0.5)), 1, 1e-3);
  EXPECT_NEAR(s.integrals(0).volume / (4 * pi / 3 * (std::pow(0.75, 3) - std::pow(0.5, 3))), 1,
              1e-3);
}

TEST(Components, OfARingAndTheBallInItAreTwo) {
  const Found s(64, [](const Vec3& x) { return std::min(ring(x, 0.6, 0.15), ball(x, {}, 0.3)); });
  ASSERT_EQ(s.components.count(), 2);
  EXPECT_NEAR(s.integrals(0).volume / (2 * pi * pi * 0.6 * 0.15 * 0.15), 1, 2e-3);
  EXPECT_NEAR(s.integrals(1).volume / (4 * pi / 3 * 0.3 * 0.3 * 0.3), 1, 2e-3);
}

TEST(Components, AreOneWhereTheyHoldAllTogether) {
  const Grid grid = Grid::cube(32, 1);
  Components components(grid, false);
  components.follow(at_nodes(grid, [](const Vec3& x) {
    return std::min(ball(x, {0, 0, 0.5}, 0.3), ball(x, {0, 0, -0.5}, 0.3));
  }));
  EXPECT_EQ(components.count(), 1);
}

/// Balls along x, by their centres and radii.
std::vector<double> row(const Grid& grid, const std::vector<std::array<double, 2>>& balls) {
  return at_nodes(grid, [&](const Vec3& x) {
    double least = 1;
    for (const auto& [at, R] : balls) least = std::min(least, ball(x, {at, 0, 0}, R));
    return least;
  });
}

/// Successions of rows of balls.
class Row {
public:
  Succession become(const std::vector<std::array<double, 2>>& balls) {
    components.follow(row(grid, balls));
    Succession s = components.succession();
    components.settle();
    return s;
  }
  int at(double x) const { return components.settled().at(grid.nearest({x, 0, 0})); }

  Grid grid{{64, 32, 32}, 0.05};
  Components components{grid, true};
};

TEST(Components, KeepTheirNumberWhileOthersPartAndMeet) {
  Row row;
  EXPECT_TRUE(row.become({{-0.8, 0.5}, {0.6, 0.6}}).before.size() == 1);
  EXPECT_EQ(row.at(0.6), 0) << "the largest piece";
  EXPECT_EQ(row.at(-0.8), 1);
  EXPECT_TRUE(row.become({{-0.8, 0.5}, {0.65, 0.6}}).is_unchanged());
  const Succession parted = row.become({{-1, 0.25}, {-0.45, 0.2}, {0.65, 0.6}});
  EXPECT_EQ(row.at(0.65), 0);
  EXPECT_EQ(row.at(-1), 1);
  EXPECT_EQ(row.at(-0.45), 2);
  EXPECT_TRUE(parted.is_unchanged(parted.after[0]));
  EXPECT_FALSE(parted.is_unchanged(parted.after[1]));
  EXPECT_EQ(parted.after[1], parted.after[2]);
  EXPECT_EQ(parted.before[1], parted.after[1]);
  const Succession met = row.become({{-1, 0.25}, {0.3, 0.9}});
  EXPECT_EQ(row.at(0.3), 0);
  EXPECT_EQ(row.at(-1), 1);
  EXPECT_EQ(met.before[0], met.before[2]);
  EXPECT_EQ(met.after.size(), 2u);
  const Succession vanished = row.become({{0.3, 0.9}});
  EXPECT_EQ(row.components.count(), 1);
  EXPECT_EQ(vanished.after.size(), 1u);
  EXPECT_NE(vanished.before[1], vanished.after[0]);
}

TEST(Components, TooSmallCountToWhatTheyCameOff) {
  Row row;
  row.become({{-0.8, 0.5}, {0.6, 0.5}});
  const Succession s = row.become({{-0.9, 0.35}, {-0.45, 0.07}, {0.6, 0.5}});
  EXPECT_TRUE(s.is_unchanged());
  EXPECT_EQ(row.at(-0.45), row.at(-0.9));
}

// -----------------------------------------------------------------------------------------------
// what is handed on

Quantities columns(const std::vector<Eigen::Vector4d>& vesicles) {
  Quantities q(4, vesicles.size());
  for (std::size_t k = 0; k < vesicles.size(); k++) q.col(Eigen::Index(k)) = vesicles[k];
  return q;
}

TEST(HeldQuantities, GoToThePiecesInProportion) {
  Constraints constraints{Scene{}};
  constraints.begin(columns({{2, 10, -12, 0}}));
  constraints.hand_on({{0}, {0, 0}});
  const Quantities pieces = columns({{1.5, 6, -7, 0}, {0.4, 2, -3, 0}});
  EXPECT_NEAR(constraints.drift(pieces, 0), 1 - 8. / 10, 1e-12)
      << "what is missing is missing of all";
  EXPECT_TRUE(constraints.keep_apart(pieces));
  EXPECT_FALSE(constraints.keep_apart(pieces));
  const Quantities target = constraints.target(0);
  EXPECT_NEAR(target(0, 0), 2 * 1.5 / 1.9, 1e-12);
  EXPECT_NEAR(target(1, 1), 10 * 2. / 8, 1e-12);
  EXPECT_NEAR(target.row(0).sum(), 2, 1e-12);
  EXPECT_NEAR(target.row(1).sum(), 10, 1e-12);
  constraints.hand_on({{0, 0}, {0}});
  EXPECT_NEAR(constraints.target(0)(0), 2, 1e-12) << "the sum";
  EXPECT_NEAR(constraints.target(0)(1), 10, 1e-12);
}

TEST(HeldQuantities, OfEachPhaseGoInProportionToThatPhase) {
  Scene scene;
  scene.domains.kind = DomainsKind::cap;
  Constraints constraints(scene);
  constraints.begin(columns({{2, 10, -12, 4}}));
  constraints.hand_on({{0}, {0, 0}});
  constraints.keep_apart(columns({{1, 6, -7, 3.5}, {0.5, 2.5, -3, 0}}));
  const Quantities target = constraints.target(0);
  EXPECT_NEAR(target(3, 0), 4, 1e-12);
  EXPECT_NEAR(target(3, 1), 0, 1e-12);
  EXPECT_NEAR(target(1, 0), 4 + 6 * 0.5, 1e-12) << "half of Lo";
  EXPECT_NEAR(target(1, 1), 6 * 0.5, 1e-12);
}

TEST(HeldQuantities, OfWhatVanishesAreGone) {
  Constraints constraints{Scene{}};
  constraints.begin(columns({{2, 10, -12, 0}, {1, 5, -6, 0}}));
  constraints.hand_on({{0, 1}, {1}});
  EXPECT_NEAR(constraints.target(0)(0), 1, 1e-12);
  EXPECT_NEAR(constraints.target(0)(1), 5, 1e-12);
}

TEST(HeldQuantities, AreThoseOfAllUntilTwoCutsAtATimeAreMade) {
  Constraints constraints{Scene{}};
  constraints.begin(columns({{2, 10, -12, 0}}));
  constraints.hand_on({{0}, {0, 0}});
  constraints.hand_on({{0, 1}, {0, 1, 0}});
  constraints.keep_apart(columns({{1, 4, -5, 0}, {1, 4, -5, 0}, {0.5, 2, -3, 0}}));
  EXPECT_NEAR(constraints.target(0)(1, 1), 4, 1e-12);
  EXPECT_NEAR(constraints.target(0)(1, 2), 2, 1e-12);
}

TEST(HeldQuantities, OfSeveralVesiclesAreLedAtOneRate) {
  Scene scene;
  scene.volume.constraint = Constraint::ramped;
  scene.volume.ramp = {{0.5}, {0}, 0.1};
  Constraints constraints(scene);
  const Quantities start = columns({{2, 10, -12, 0}, {1, 5, -6, 0}});
  constraints.begin(start);
  const Quantities later = constraints.target(0.1);
  EXPECT_NEAR(later(0, 0) / start(0, 0), later(0, 1) / start(0, 1), 1e-12);
  EXPECT_NEAR(later(0, 0) / start(0, 0), 0.982, 0.001);
  EXPECT_NEAR((constraints.rate(0.05) * 0.1 - (later - start)).norm(), 0, 1e-6);
}

TEST(HeldQuantities, HaveMultipliersOfTheirOwnOrInCommon) {
  const Found s(40, [](const Vec3& x) {
    const double a = std::hypot(x[0] / 0.45, x[1] / 0.35, (x[2] - 0.45) / 0.3) - 1,
                 b = std::hypot(x[0] / 0.5, x[1] / 0.5, (x[2] + 0.45) / 0.35) - 1;
    return 0.3 * std::min(a, b);
  });
  std::vector<double> F(s.geometry.size());
  SurfaceEnergy(SurfaceModuli{1, -3}).find_forces(s.geometry, {}, {}, F);
  std::vector<SurfaceIntegrals> each;
  for (int k = 0; k < 2; k++) each.push_back(integrate(s.geometry, {F}, s.components.samples(k)));
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(6, 6);
  Eigen::VectorXd variation(6);
  for (int k = 0; k < 2; k++) {
    gram.block<3, 3>(3 * k, 3 * k) = each[k].gram.topLeftCorner<3, 3>();
    variation.segment<3>(3 * k) = each[k].variation;
  }
  for (const Of volume : {Of::each, Of::all})
    for (const Of area : {Of::each, Of::all}) {
      Scene scene;
      scene.volume.of = volume;
      scene.area.of = area;
      Constraints constraints(scene);
      constraints.begin(quantities(each));
      const Eigen::VectorXd m = constraints.multipliers(gram, variation, Quantities::Zero(4, 2));
      Quantities rates = Quantities::Zero(4, 2);
      double scale = 0;
      for (std::size_t i = 0; i < s.geometry.size(); i++) {
        const int k = s.components.of_sample(i);
        const double KM = s.geometry.KM()[i], w = s.geometry.weight()[i],
                     v = -F[i] + m[3 * k] + m[3 * k + 1] * KM;
        rates.col(k) += w * v * Eigen::Vector4d(1, -KM, 0, 0);
        scale += w * std::abs(v);
      }
      for (const auto& [row, of] : {std::pair{0, volume}, {1, area}}) {
        EXPECT_NEAR(rates.row(row).sum(), 0, 5e-5 * scale); // measured 2.3e-5
        EXPECT_EQ(m[row] == m[3 + row], of == Of::all);
        EXPECT_EQ(std::abs(rates(row, 0)) < 5e-5 * scale, of == Of::each);
      }
    }
}

// -----------------------------------------------------------------------------------------------
// runs

/// Two ellipsoids of different size and shape, a gap of several spacings between them.
Scene two_vesicles(Of of) {
  Scene scene;
  scene.nodes = {40, 40, 40};
  scene.membrane.spontaneous_curvature = -5;
  scene.volume.of = scene.area.of = of;
  scene.end_time = 2e-4;
  return scene;
}

Start two_ellipsoids(const Grid& grid) {
  return {.phi = at_nodes(grid, [](const Vec3& x) {
            const double a = std::hypot(x[0] / 0.55, x[1] / 0.45, (x[2] - 0.45) / 0.25) - 1,
                         b = std::hypot(x[0] / 0.4, x[1] / 0.35, (x[2] + 0.35) / 0.35) - 1;
            return 0.3 * std::min(a, b);
          })};
}

/// Volume and area of each, in turn.
std::vector<double> held(const Simulation& sim) {
  std::vector<double> all;
  for (const ComponentMeasures& m : sim.component_measures()) {
    all.push_back(m.volume);
    all.push_back(m.area);
  }
  return all;
}

double furthest_off(const std::vector<double>& now, const std::vector<double>& before) {
  double worst = 0;
  for (std::size_t i = 0; i < now.size(); i++)
    worst = std::max(worst, std::abs(now[i] / before.at(i) - 1));
  return worst;
}

TEST(TwoVesicles, KeepTheirOwnWhereTheyAreHeldOfEach) {
  const Scene scene = two_vesicles(Of::each);
  Simulation sim(scene, two_ellipsoids(scene.grid()));
  const std::vector<double> start = held(sim);
  ASSERT_EQ(start.size(), 4u);
  double energy = sim.measures().energy;
  while (sim.time() < scene.end_time) {
    sim.step(scene.end_time);
    EXPECT_LE(furthest_off(held(sim), start), 1e-5) << sim.time();
    EXPECT_LE(sim.measures().energy, energy);
    energy = sim.measures().energy;
  }
  const std::vector<ComponentMeasures> end = sim.component_measures();
  const Measures m = sim.measures();
  const double area = end[0].area + end[1].area, volume = end[0].volume + end[1].volume;
  EXPECT_NEAR(m.sigma, (end[0].sigma * end[0].area + end[1].sigma * end[1].area) / area,
              1e-9 * std::abs(m.sigma));
  EXPECT_NEAR(m.P, (end[0].P * end[0].volume + end[1].P * end[1].volume) / volume,
              1e-9 * std::abs(m.P));
  EXPECT_GT(std::abs(end[0].P - end[1].P), 10);
  EXPECT_NEAR(m.area, area, 1e-12);
  EXPECT_NEAR(end[0].center[2], 0.45, 2e-3); // measured 5e-4
  EXPECT_NEAR(end[1].center[2], -0.35, 2e-3);
}

TEST(TwoVesicles, ExchangeWhereTheyAreHeldOfAll) {
  const Scene scene = two_vesicles(Of::all);
  Simulation sim(scene, two_ellipsoids(scene.grid()));
  while (sim.time() < scene.end_time) sim.step(scene.end_time);
  const Scene apart = two_vesicles(Of::each);
  const Simulation start(apart, two_ellipsoids(scene.grid()));
  EXPECT_NEAR(sim.measures().area / start.measures().area, 1, 1e-5);
  EXPECT_NEAR(sim.measures().volume / start.measures().volume, 1, 1e-5);
  // The end of this run, seen by one that tells its vesicles apart.
  const Simulation end(apart, Start{.phi = sim.frame().phi});
  EXPECT_GT(furthest_off(held(end), held(start)), 2e-3); // measured 3.5e-3
}

TEST(TwoVesicles, ThatAreSpheresStaySpheres) {
  Scene scene = two_vesicles(Of::each);
  scene.end_time = 1e-3;
  Simulation sim(scene,
                 Start{.phi = at_nodes(scene.grid(), [](const Vec3& x) {
                         return std::min(ball(x, {0, 0, -0.35}, 0.4), ball(x, {0, 0, 0.5}, 0.2));
                       })});
  const std::vector<double> start = held(sim);
  while (sim.time() < scene.end_time) {
    sim.step(scene.end_time);
    EXPECT_LE(furthest_off(held(sim), start), 1e-5) << sim.time();
  }
  for (const ComponentMeasures& m : sim.component_measures())
    EXPECT_NEAR(m.reduced_volume, 1, 1e-3);
}

/// Half of the first is Ld, a third of the second; where `pure`, all of the second.
Start two_phases(const Grid& grid, bool pure) {
  Start start = two_ellipsoids(grid);
  start.fields["psi"] = at_nodes(grid, [=](const Vec3& x) {
    return x[2] > 0.05 ? x[0] : pure ? -0.5 : x[0] + 0.12;
  });
  return start;
}

TEST(TwoVesicles, KeepTheirAreaOfEachPhase) {
  for (const double stretch : {0., 500.})
    for (const bool pure : {false, true}) {
      Scene scene = two_vesicles(Of::each);
      scene.domains.kind = DomainsKind::cap;
      scene.ld.bending_modulus = 1;
      scene.lo.bending_modulus = 2;
      scene.line.tension = 10;
      scene.stretch.modulus = stretch;
      scene.end_time = 2e-5;
      Simulation sim(scene, two_phases(scene.grid(), pure));
      const std::vector<ComponentMeasures> start = sim.component_measures();
      ASSERT_EQ(start.size(), 2u);
      EXPECT_NEAR(*start[1].area_Ld / start[1].area, pure ? 1 : 0.33, 0.05);
      double energy = sim.measures().energy;
      while (sim.time() < scene.end_time) {
        sim.step(scene.end_time);
        const std::vector<ComponentMeasures> now = sim.component_measures();
        for (int k = 0; k < 2; k++) {
          EXPECT_NEAR(now[k].volume / start[k].volume, 1, 2e-5);
          EXPECT_NEAR(now[k].area / start[k].area, 1, 2e-5);
          const double Ld = *now[k].area_Ld;
          if (k == 1 && pure) // but for what is smeared of the boundary on the other one, near by
            EXPECT_NEAR(Ld / now[k].area, 1, 5e-3); // measured 2.1e-3
          else
            EXPECT_NEAR(Ld / *start[k].area_Ld, 1, 2e-5);
        }
        EXPECT_LE(sim.measures().energy, energy);
        energy = sim.measures().energy;
      }
    }
}

TEST(TwoVesicles, AreTheSameForAnyNumberOfThreads) {
  const Scene scene = two_vesicles(Of::each);
  std::vector<double> energies[2];
  for (const int threads : {1, 3}) {
    set_thread_count(threads);
    Simulation sim(scene, two_ellipsoids(scene.grid()));
    for (int step = 0; step < 12; step++) {
      sim.step(scene.end_time);
      energies[threads == 3].push_back(sim.measures().energy);
    }
  }
  set_thread_count(0);
  EXPECT_EQ(energies[0], energies[1]);
}

TEST(TwoVesicles, HoldTheSumOnceTheyFused) {
  Scene scene = two_vesicles(Of::each);
  scene.membrane.spontaneous_curvature = 0;
  scene.volume.constraint = Constraint::free; // they swell until they meet
  scene.volume.pressure = 300;
  scene.end_time = 2e-3;
  Simulation sim(
      scene, Start{.phi = at_nodes(scene.grid(), [](const Vec3& x) {
                     const double a = std::hypot(x[0] / 0.55, x[1] / 0.5, (x[2] - 0.32) / 0.28) - 1,
                                  b = std::hypot(x[0] / 0.4, x[1] / 0.5, (x[2] + 0.32) / 0.28) - 1;
                     return 0.3 * std::min(a, b);
                   })});
  ASSERT_EQ(sim.component_measures().size(), 2u);
  const double area = sim.measures().area;
  while (sim.time() < scene.end_time && sim.measures().components == 2) sim.step(scene.end_time);
  for (int steps = 0; steps < 10; steps++) {
    sim.step(scene.end_time);
    EXPECT_NEAR(sim.measures().area / area, 1, 1e-5);
  }
  EXPECT_EQ(sim.component_measures().size(), 1u);
  EXPECT_EQ(count(sim.events(), Event::Kind::fusion), 1);
}

/// fig6b with vesicles that keep their own; its buds come off by 4e-5.
Scene budding() {
  Scene scene = builtin_scene("fig6b");
  scene.nodes = {48, 48, 48};
  scene.volume.of = scene.area.of = Of::each;
  scene.end_time = 6e-5;
  return scene;
}

TEST(Pieces, KeepWhatTheyHadWhenTheyParted) {
  const Scene scene = budding();
  Simulation sim(scene);
  const Measures start = sim.measures();
  std::vector<double> at_parting;
  while (sim.time() < scene.end_time) {
    const bool apart = sim.measures().components == 3;
    if (apart && at_parting.empty()) at_parting = held(sim);
    sim.step(scene.end_time);
    if (apart) {
      const Measures& m = sim.measures();
      EXPECT_LE(std::max(std::abs(m.area_drift), std::abs(m.volume_drift)), 5e-6) << m.time;
      EXPECT_LE(furthest_off(held(sim), at_parting), 1e-5) << "itself up to 5e-6 off";
      EXPECT_LE(*m.energy_rise, 1e-3);
    }
  }
  ASSERT_EQ(at_parting.size(), 6u);
  double volume = 0, area = 0;
  for (const ComponentMeasures& m : sim.component_measures()) {
    volume += m.volume;
    area += m.area;
  }
  EXPECT_NEAR(volume / start.volume, 1, 1e-5) << "nothing is lost";
  EXPECT_NEAR(area / start.area, 1, 1e-5);
  for (const Event& e : sim.events())
    EXPECT_TRUE(!e.changes_topology() || e.energy_after < e.energy_before) << to_text(e, 1);
}

} // namespace
} // namespace lamella
