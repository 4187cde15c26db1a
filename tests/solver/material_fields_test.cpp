// Fields that the membrane takes along, and energies that depend on them.
#include "dynamics/simulation.h"
#include "energy/surface_energy.h"
#include "error.h"
#include "levelset/extension.h"
#include "levelset/taylor.h"
#include "runs.h"
#include "start_surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lamella {
namespace {

using testing::HasSubstr;

double value_at(const Vec3& x) { return 1 + 0.4 * std::sin(2 * x[0] + 1) * std::cos(3 * x[2]); }
double amount_at(const Vec3& x) { return 1 + 0.3 * std::cos(2.5 * x[1] - x[0]); }
double profile(const Vec3& x) {
  return std::cos(2 * x[0] + 1) * std::cos(1.5 * x[1]) + 0.5 * std::sin(2 * x[2]);
}

/// K_M of a level set.
double KM_of(const Taylor& f) {
  const double slope = f.gradient.norm();
  const Eigen::Vector3d N = f.gradient / slope;
  return -(f.hessian.trace() - N.dot(f.hessian * N)) / slope;
}

const MaterialFields fields{{"s", "", Carried::value}, {"m", "", Carried::amount}};

/// An ellipsoid, displaced along its normals by size * profile / |grad phi|, with the fields that
/// it then has.
struct Displaced : StartSurface {
  SurfaceEnergy energy;
  std::vector<CarriedField> carried;
  std::vector<double> variation;

  Displaced(const std::string& density, double size)
      : StartSurface(nodal(size), Grid::cube(64, 1)), energy(moduli(density), {}, fields) {
    geometry.jets(phi, band, std::max(Derivatives::gradient, energy.needs()));
    const StartSurface rest(nodal(0), grid);
    const auto amount = [&](const Vec3& x) {
      const Eigen::Vector3d place(x[0], x[1], x[2]);
      const Taylor f = taylor(rest.phi, {&place, 1})[0];
      return amount_at(x) * (1 + KM_of(f) * size * profile(x) / f.gradient.norm());
    };
    Extension extension(grid);
    for (const MaterialField& field : fields) {
      carried.emplace_back(field.name, field.carried, grid, fourier);
      if (field.carried == Carried::value)
        carried.back().start(value_at, rest.band, extension);
      else
        carried.back().start(amount, rest.band, extension);
      carried.back().sample(geometry);
    }
    variation.resize(geometry.size());
    energy.find_forces(geometry, {}, {}, variation, jets_of(carried));
  }

  static SurfaceModuli moduli(const std::string& density) {
    SurfaceModuli moduli;
    moduli.density = density;
    return moduli;
  }
  static std::vector<double> nodal(double size) {
    const Grid grid = Grid::cube(64, 1);
    std::vector<double> phi =
        initial_phi(moved(ellipsoid({0.7, 0.6, 0.5}), {0.01, 0.02, -0.01}, 25), grid);
    for (std::size_t i = 0; i < phi.size(); i++) phi[i] -= size * profile(grid.position(i));
    return phi;
  }
  double value() const {
    EnergyTerms terms;
    energy.find_energies(geometry, terms);
    return terms.sum();
  }
  double work() const {
    double sum = 0;
    for (std::size_t i = 0; i < geometry.size(); i++)
      if (const double w = geometry.weight()[i]; w != 0)
        sum += w * variation[i] * profile(geometry.point(i)) / geometry.grad()[i];
    return sum;
  }
};

TEST(MaterialFields, ForcesAreDifferencesOfTheEnergy) {
  for (const char* density :
       {"3*s", "3*m", "2*s^2*m", "s*(KM + 3*s)^2", "m*(KM + 1)^2", "0.8*s*K", "m*K",
        "0.02*s*KM^4*m", "exp(-0.3*KM*s)*(1 + m^2)", "0.1*m*KM^2*K + s/(2 + KM^2)"}) {
    constexpr double size = 1e-3;
    const double difference =
        (Displaced(density, size).value() - Displaced(density, -size).value()) / (2 * size);
    const double work = Displaced(density, 0).work();
    EXPECT_NEAR(work, difference, 1e-3 * std::abs(difference)) << density; // 5e-4
  }
}

Scene relaxing(int nodes, double end_time, double longest_step) {
  Scene scene =
      scene_of(moved(ellipsoid({0.65, 0.5, 0.35}), {0.01, 0.02, -0.01}, 25), nodes, end_time);
  scene.numerics = {.tolerance = 0.1, .max_time_step = longest_step};
  return scene;
}

/// At the samples of a state, with their weights.
struct Looked {
  std::vector<double> weight;
  std::vector<std::vector<double>> values;
};
Looked look(const Frame& frame, const std::vector<std::string>& names) {
  StartSurface s(frame.phi, frame.grid);
  s.measure(); // nearest points go by one Newton step at a time
  std::vector<Eigen::Vector3d> places;
  Looked all;
  for (std::size_t i = 0; i < s.geometry.size(); i++) {
    const Vec3 x = s.geometry.point(i);
    places.push_back({x[0], x[1], x[2]});
    all.weight.push_back(s.geometry.weight()[i]);
  }
  for (const std::string& name : names) {
    LevelSet m(frame.grid);
    std::ranges::copy(frame.field(name), m.coefficients().begin());
    m.fit(frame.field(name), s.fourier, 60);
    std::vector<double>& values = all.values.emplace_back();
    for (const Taylor& t : taylor(m, places)) values.push_back(t.value);
  }
  return all;
}

/// int g(s) m dA
double content(const Frame& frame, double (*g)(double)) {
  const Looked at = look(frame, {"s", "m"});
  double sum = 0;
  for (std::size_t i = 0; i < at.weight.size(); i++)
    if (at.weight[i] != 0) sum += at.weight[i] * g(at.values[0][i]) * at.values[1][i];
  return sum;
}

/// By how much what is on the points of some values of s changes, relative to all.
double lost(double (*g)(double), double longest_step) {
  Scene scene = relaxing(48, 4e-4, longest_step);
  scene.membrane.density = "0*s*m";
  scene.fields = {{"s", "x", Carried::value}, {"m", "1 + 0.5*y", Carried::amount}};
  Simulation run(scene);
  const double before = content(run.frame(), g);
  while (run.time() < scene.end_time) run.step(scene.end_time);
  return std::abs(content(run.frame(), g) - before) /
         content(run.frame(), [](double) { return 1.; });
}

// Whatever is marked by s keeps its m.
TEST(MaterialFields, KeepTheirValuesAndAmountsOnEveryPart) {
  for (const auto g : {+[](double) { return 1.; }, +[](double s) { return s; },
                       +[](double s) { return std::exp(3 * s); }}) {
    const double coarse = lost(g, 2e-5), fine = lost(g, 5e-6);
    EXPECT_LT(fine, 2e-5);         // measured 2e-7, 2e-6, 6e-6
    EXPECT_LT(fine, 0.5 * coarse); // 0.26, 0.16, 0.05
  }
}

double error_of_start(int nodes) {
  Scene scene = relaxing(nodes, 1e-4, 0);
  scene.membrane.density = "a*s";
  scene.parameters = {{"a", 2}};
  scene.fields = {{"s", "a + x^2 - sin(3*y)*z", Carried::value}};
  const Frame frame = Simulation(scene).frame();
  StartSurface s(frame.phi, frame.grid);
  s.measure();
  const Looked at = look(frame, {"s"});
  double most = 0;
  for (std::size_t i = 0; i < at.weight.size(); i++) {
    const Vec3 x = s.geometry.point(i);
    if (at.weight[i] == 0) continue;
    const double exact = 2 + x[0] * x[0] - std::sin(3 * x[1]) * x[2];
    most = std::max(most, std::abs(at.values[0][i] - exact));
  }
  return most;
}

TEST(MaterialFields, StartOnTheStartShape) {
  const double coarse = error_of_start(32), fine = error_of_start(64);
  EXPECT_LT(fine, 1.5e-4);        // measured 7e-5
  EXPECT_LT(fine, 0.25 * coarse); // 0.12
}

TEST(MaterialFields, ThatAreTheSameEverywhereAreNumbers) {
  Scene number = relaxing(32, 5e-5, 0), field = number;
  number.membrane.density = "0.03*KM^4 + 5";
  field.membrane.density = "s*KM^4 + 5";
  field.fields = {{"s", "0.03 + 0*x", Carried::value}};
  Simulation a(number), b(field);
  while (a.time() < number.end_time) {
    a.step(number.end_time);
    b.step(number.end_time);
    ASSERT_NEAR(b.measures().energy, a.measures().energy, 1e-9 * a.measures().energy);
    ASSERT_NEAR(b.time(), a.time(), 1e-9 * a.time());
  }
}

TEST(MaterialFields, StartFromArraysOfAFrame) {
  Scene first = relaxing(32, 1e-5, 0);
  first.membrane.density = "s";
  first.fields = {{"s", "1 + 0.2*x", Carried::value}};
  Simulation run(first);
  const Frame frame = run.frame();
  Scene next = first;
  next.shape = {.kind = ShapeKind::frame, .file = "memory"};
  for (const char* start : {"", "s"}) {
    next.fields[0].start = start;
    const Simulation again(next, start_of(next, frame));
    const Looked now = look(frame, {"s"}), then = look(again.frame(), {"s"});
    ASSERT_EQ(then.weight.size(), now.weight.size());
    double most = 0;
    for (std::size_t i = 0; i < now.weight.size(); i++)
      if (now.weight[i] != 0) most = std::max(most, std::abs(then.values[0][i] - now.values[0][i]));
    EXPECT_LT(most, 1e-4);
  }
  next.fields[0].start = "other";
  try {
    start_of(next, frame);
    FAIL();
  } catch (const RunError& e) {
    EXPECT_STREQ(e.what(),
                 "the field s starts from an array \"other\" that is not there; there are s");
  }
  next.fields[0].start = "log(x)";
  next.shape = first.shape;
  try {
    Simulation bad(next);
    FAIL();
  } catch (const RunError& e) {
    EXPECT_THAT(e.what(), HasSubstr("the field s is not finite at ("));
  }
}

} // namespace
} // namespace lamella
