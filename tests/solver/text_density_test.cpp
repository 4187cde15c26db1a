// Densities of the energy as text: what they make of the curvatures, beside the same built in, and
// the force that follows, beside differences of the energy.
#include "dynamics/simulation.h"
#include "energy/helfrich.h"
#include "energy/monomial.h"
#include "energy/surface_energy.h"
#include "energy/text_density.h"
#include "energy/text_line_density.h"
#include "runs.h"
#include "scene/densities.h"
#include "start_surface.h"

#include <random>

namespace lamella {
namespace {

const Parameters names{{"a", 0.4}, {"C0", -1.7}};

/// Places with random curvatures and derivatives, all with the same curvature tensor.
class Places {
public:
  Jet jet(double about) {
    Jet jet;
    jet.f = numbers() + about;
    for (int d = 0; d < 3; d++) jet.grad[d] = numbers();
    const auto& [x, y, z] = jet.grad;
    jet.B_grad = {2 * x - y + 0.3 * z, -x + 0.5 * y + 0.7 * z, 0.3 * x + 0.7 * y - z};
    jet.lap = numbers();
    jet.B_hess = numbers();
    return jet;
  }
  Univariate univariate(double about) { return {about + number(), number(), number()}; }

  SurfacePoint<Jet> place() {
    const Jet step = jet(0.5);
    return {jet(-2), jet(1), {step, step, step}};
  }

private:
  double number() { return std::uniform_real_distribution(-0.5, 0.5)(random_); }
  Lanes numbers() {
    Lanes x;
    for (int l = 0; l < 8; l++) x[l] = number();
    return x;
  }
  std::mt19937 random_{7};
};

void expect_same(const Lanes& a, const Lanes& b) {
  for (int l = 0; l < 8; l++) EXPECT_NEAR(a[l], b[l], 1e-13 * (1 + std::abs(b[l])));
}

void expect_same(const Jet& a, const Jet& b) {
  expect_same(a.f, b.f);
  for (int d = 0; d < 3; d++) {
    expect_same(a.grad[d], b.grad[d]);
    expect_same(a.B_grad[d], b.B_grad[d]);
  }
  expect_same(a.lap, b.lap);
  expect_same(a.B_hess, b.B_hess);
}

void expect_same(const SurfaceTerm& text, const SurfaceTerm& built_in) {
  Places places;
  const SurfacePoint<Jet> at = places.place();
  Partials<Jet> a, b;
  expect_same(text.add(at, a), built_in.add(at, b));
  expect_same(a.by_KM, b.by_KM);
  expect_same(a.by_K, b.by_K);

  const SurfacePoint<Lanes> values{
      at.KM.f, at.K.f, {at.steps.monotonic.f, at.steps.monotonic.f, at.steps.monotonic.f}};
  SecondPartials c, d;
  text.add(values, c);
  built_in.add(values, d);
  expect_same(c.KM_KM, d.KM_KM);
  expect_same(c.KM_K, d.KM_K);
  expect_same(c.K_K, d.K_K);

  const Univariate step = places.univariate(0.5);
  const SurfacePoint<Univariate> way{
      places.univariate(-2), places.univariate(1), {step, step, step}};
  const Univariate e = text.across(way), f = built_in.across(way);
  EXPECT_NEAR(e.f, f.f, 1e-13);
  EXPECT_NEAR(e.d1, f.d1, 1e-13);
  EXPECT_NEAR(e.d2, f.d2, 1e-12);
}

TEST(TextDensity, IsTheTermThatIsBuiltIn) {
  constexpr Profile monotonic = Profile::monotonic;
  const auto text = [](const char* ld, const char* lo) { return TextDensity(ld, lo, names); };
  expect_same(text("a*KM^4", "a*KM^4"), Monomial<Term::quartic, 4, 0>({0.4, 0.4, monotonic}));
  expect_same(text("a*KM^2*K", "0.1*K*KM^2"),
              Monomial<Term::mixed_quartic, 2, 1>({0.4, 0.1, monotonic}));
  expect_same(text("K*2*K", ""), Monomial<Term::gaussian_square, 0, 2>({2, 0, monotonic}));
  expect_same(text("a/2*(KM - C0)^2", "a/2*(KM - C0)^2"),
              Helfrich({0.4, 0.4, Profile::compliance}, {-1.7, -1.7}));
}

/// A density in C++ that calls each of the functions.
class AllFunctions : public DensityTerm<AllFunctions> {
public:
  static constexpr bool depends_on_K = true;

  TermName term() const override { return "all_functions"; }
  Derivatives needs() const override { return Derivatives::all; }
  bool differs_between_phases() const override { return false; }

  template <class C, class N>
  N density(const Steps<C>&, const N& KM, const N& K) const {
    using F = Function;
    const N x = KM * K, s = constant<N>(2) + K;
    return apply(F::reciprocal, s) + apply(F::sqrt, s) + apply(F::exp, x) + apply(F::log, s) +
           apply(F::sin, x) + apply(F::cos, x) + apply(F::tan, 0.3 * K) + apply(F::sinh, KM) +
           apply(F::cosh, x) + apply(F::tanh, x) + apply(F::atan, x);
  }
};

TEST(TextDensity, IsTheDensityInCpp) {
  const std::string text = "1/(2 + K) + sqrt(2 + K) + exp(KM*K) + log(2 + K) + sin(KM*K) + "
                           "cos(KM*K) + tan(0.3*K) + sinh(KM) + cosh(KM*K) + tanh(KM*K) + "
                           "atan(KM*K)";
  expect_same(TextDensity(text, text, names), AllFunctions());
}

TEST(TextDensity, AsksForNoMoreDerivativesThanItNeeds) {
  const auto needs = [](const std::string& ld, const std::string& lo) {
    return TextDensity(ld, lo, names).needs();
  };
  EXPECT_EQ(needs("a*(KM - C0)^2 + 3*K", ""), Derivatives::laplacian);
  EXPECT_EQ(needs("a*(KM - C0)^2", "exp(KM)"), Derivatives::gradient);
  EXPECT_EQ(needs("KM*K", "KM"), Derivatives::all);
  EXPECT_EQ(needs("sqrt(2 + K)", "sqrt(2 + K)"), Derivatives::all);
}

/// An ellipsoid with a density, displaced along its normals by size * profile / |grad phi|.
struct Displaced : StartSurface {
  static double profile(const Vec3& x) {
    return std::cos(2 * x[0] + 1) * std::cos(1.5 * x[1]) + 0.5 * std::sin(2 * x[2]);
  }

  SurfaceEnergy energy;
  std::vector<double> variation;

  Displaced(const SurfaceModuli& moduli, const Parameters& parameters, double size)
      : StartSurface(nodal(size), Grid::cube(64, 1)), energy(moduli, parameters) {
    geometry.jets(phi, band, energy.needs());
    variation.resize(geometry.size());
    energy.find_forces(geometry, {}, {}, variation);
  }

  static std::vector<double> nodal(double size) {
    const Grid grid = Grid::cube(64, 1);
    std::vector<double> phi =
        initial_phi(moved(ellipsoid({0.7, 0.6, 0.5}), {0.01, 0.02, -0.01}, 25), grid);
    for (std::size_t i = 0; i < phi.size(); i++) phi[i] -= size * profile(grid.position(i));
    return phi;
  }
  double value(Term term) const {
    EnergyTerms terms;
    energy.find_energies(geometry, terms);
    return terms.value(term);
  }
  double work() const {
    double sum = 0;
    for (std::size_t i = 0; i < geometry.size(); i++)
      if (const double w = geometry.weight()[i]; w != 0)
        sum += w * variation[i] * profile(geometry.point(i)) / geometry.grad()[i];
    return sum;
  }
};

TEST(TextDensity, ForceIsTheDifferenceOfTheEnergy) {
  const Parameters parameters{{"a", 0.4}};
  for (const char* density : {"a*KM^4", "0.05*KM^3*K", "tanh(a*KM*K)", "exp(-a*KM)/(2 + K^2)",
                              "sqrt(1 + (KM^2 - 4*K)^2)"}) {
    SurfaceModuli moduli;
    moduli.density = density;
    constexpr double size = 1e-3;
    const Displaced plus(moduli, parameters, size), minus(moduli, parameters, -size);
    double difference = 0;
    for (const Term term : {Term::bending, Term::density})
      difference += (plus.value(term) - minus.value(term)) / (2 * size);
    const double work = Displaced(moduli, parameters, 0).work();
    EXPECT_NEAR(work, difference, 2e-3 * std::abs(difference)) << density; // 8e-4; 48 nodes: 6e-3
  }
}

Scene scene_with(const std::string& density) {
  Scene scene =
      scene_of({.kind = ShapeKind::oblate, .semi_axis = 0.6, .reduced_volume = 0.8}, 32, 1e-4);
  scene.membrane.density = density;
  return scene;
}

TEST(TextDensity, MovesAVesicleAsItsModulusDoes) {
  Scene built_in = scene_with(""), text = scene_with("0.03*KM^4");
  built_in.membrane.quartic_modulus = 0.03;
  const Measures a = Simulation(text).measures(), b = Simulation(built_in).measures();
  EXPECT_NEAR(a.terms.value(Term::density), b.terms.value(Term::quartic),
              1e-10 * b.terms.value(Term::quartic));
  EXPECT_NEAR(a.max_speed, b.max_speed, 1e-10 * b.max_speed);
  EXPECT_NEAR(a.energy, b.energy, 1e-10 * b.energy);
}

TEST(TextDensity, OnTheLineHasItsDerivatives) {
  CurveGeometry c{};
  c.kg = 1.3;
  c.kn = -2.1;
  c.tau_g = 0.4;
  const LineDensity::Value l =
      TextLineDensity("exp(a*kg - kn)*tau_g^2", names_on_line({{"a", 0.3}})).at(c);
  const double e = std::exp(0.3 * c.kg - c.kn);
  EXPECT_NEAR(l.l, e * 0.16, 1e-14 * e);
  EXPECT_NEAR(l.kg, 0.3 * e * 0.16, 1e-14 * e);
  EXPECT_NEAR(l.kn, -e * 0.16, 1e-14 * e);
  EXPECT_NEAR(l.tau_g, 2 * e * 0.4, 1e-14 * e);
  EXPECT_EQ(l.B_perp, 0);
}

TEST(TextDensity, OnTheLineMovesAVesicleAsItsModulusDoes) {
  Scene built_in = scene_of({.kind = ShapeKind::prolate, .reduced_volume = 0.9}, 32, 1e-4);
  built_in.domains = {.kind = DomainsKind::cap, .area_fraction = 0.3, .direction = {1, 0.4, 0.2}};
  built_in.line.tension = 5;
  Scene text = built_in;
  built_in.line.geodesic_square_modulus = 0.3;
  text.line.density = "k*kg^2";
  text.parameters = {{"k", 0.3}};
  const Measures a = Simulation(text).measures(), b = Simulation(built_in).measures();
  const double energy = b.terms.value(Term::geodesic_square);
  EXPECT_GT(energy, 0.1);
  EXPECT_NEAR(a.terms.value(Term::line_density), energy, 1e-10 * energy);
  EXPECT_NEAR(a.max_speed, b.max_speed, 1e-9 * b.max_speed);
  EXPECT_NEAR(a.energy, b.energy, 1e-10 * b.energy);
}

TEST(TextDensity, OfTwoPhasesIsOnEach) {
  Scene scene = scene_of({.kind = ShapeKind::sphere, .radius = 0.6}, 48, 1e-4);
  scene.domains = {.kind = DomainsKind::cap, .area_fraction = 0.25};
  scene.line.tension = 5;
  scene.volume.constraint = Constraint::free;
  scene.ld.density = "a*KM^2";
  scene.lo.density = "b + K";
  scene.parameters = {{"a", 2}, {"b", -3}};
  const double area = 4 * std::numbers::pi * 0.36, ld = 2 * 4 / 0.36, lo = -3 + 1 / 0.36;
  EXPECT_NEAR(Simulation(scene).measures().terms.value(Term::density),
              area * (0.25 * ld + 0.75 * lo), 1e-3 * area * ld);
}

} // namespace
} // namespace lamella
