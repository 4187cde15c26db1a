// A scene in other units is the same scene: its history is the same but for units.
#include "runs.h"
#include "scene/units.h"
#include "store/history.h"

namespace lamella {
namespace {

double number(const Field& field) {
  return std::visit([](auto* x) { return double(*x); }, field.value);
}

/// The largest difference of any column, over its largest value (and 1, where it has no unit).
double difference(std::vector<Measures> a, std::vector<Measures> b, const UnitChange& units) {
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  double worst = 0;
  for (std::size_t column = 0; column < row_of(a[0]).size(); column++) {
    const std::string_view unit = row_of(a[0])[column].unit;
    double largest = unit.empty() ? 1 : 0, off = 0;
    for (std::size_t n = 0; n < a.size(); n++) {
      // Where nothing is led on, all of it is rounding.
      if (row_of(a[n])[column].column == "work")
        largest = std::max(largest, a[n].balance->dissipated);
      const double x = number(row_of(a[n])[column]),
                   y = number(row_of(b[n])[column]) / units.factor(unit);
      largest = std::max(largest, std::abs(x));
      off = std::max(off, std::abs(x - y));
    }
    if (off > 0) worst = std::max(worst, off / largest);
  }
  return worst;
}

std::vector<Measures> begin_of(const Scene& scene, int steps) {
  Simulation sim(scene);
  std::vector<Measures> history{sim.measures()};
  for (int i = 0; i < steps && sim.time() < scene.end(); i++) {
    sim.step(scene.end());
    history.push_back(sim.measures());
  }
  return history;
}

Scene one_phase() {
  return scene_of(moved(ellipsoid({0.65, 0.5, 0.3}), {0.02, 0.01, -0.015}, 20), 32, 0);
}

Scene two_phases() {
  Scene scene = one_phase();
  scene.shape = ellipsoid({0.65, 0.55, 0.45});
  scene.domains = {.kind = DomainsKind::caps, .directions = {{1, 2, 3}, {-2, -1, -2}}};
  scene.domains.half_angle = 35;
  return scene;
}

struct Kind {
  const char* name;
  Scene scene;
};

std::vector<Kind> kinds() {
  std::vector<Kind> all;
  auto add = [&](const char* name, Scene scene, auto&& set) {
    set(scene);
    all.push_back({name, scene});
  };
  add("all by default", one_phase(), [](Scene&) {});
  add("films and pressure", one_phase(), [](Scene& s) {
    s.volume = {.constraint = Constraint::free, .ramp = {}, .pressure = -60};
    s.contact.disjoining_pressure = 3000;
    s.area_difference.multiplier = 3;
    s.perturbation.amplitude = 0.01;
  });
  add("ramps", one_phase(), [](Scene& s) {
    s.volume.constraint = s.area_difference.constraint = Constraint::ramped;
    s.volume.ramp.targets = {0.8};
    s.area_difference.ramp = {{1.2}, {1e-6}};
    s.stop.energy_rate = 1e-3;
  });
  add("stretch", one_phase(), [](Scene& s) { s.stretch.modulus = 50; });
  add("C of two phases", two_phases(), [](Scene& s) {
    s.ld.spontaneous_curvature = -8;
    s.curvature_start_time = 1e-5;
  });
  add("all moduli of two phases", two_phases(), [](Scene& s) {
    s.ld = {1, -2, 1};
    s.lo = {3, 0, 0};
    s.line = {20, 0.5, 1, 1};
    s.volume.constraint = Constraint::ramped;
    s.volume.ramp.targets = {0.8};
  });
  add("stretch of two phases", two_phases(), [](Scene& s) {
    s.line.tension = 10;
    s.stretch.modulus = 100;
  });
  return all;
}

// Measured 2e-11.
TEST(Units, DoNotMatterToRuns) {
  for (const Kind& kind : kinds()) {
    const std::vector<Measures> history = begin_of(kind.scene, 20);
    for (const UnitChange& units : {UnitChange{1e-3, 1e3}, {700, 1e-3}}) {
      const std::vector<Measures> other = begin_of(in_units(kind.scene, units), 20);
      const double off = difference(history, other, units);
      EXPECT_LT(off, 1e-8) << kind.name << ", " << units.length << ", " << units.energy;
    }
  }
}

} // namespace
} // namespace lamella
