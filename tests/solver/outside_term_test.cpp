// A term of the energy that is not built in acts in a run as one that is.
#include "error.h"
#include "runs.h"
#include "scene/builtin.h"
#include "store/history.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lamella {
namespace {

/// modulus int K_M^4 dA, as quartic_modulus has it.
class OwnQuartic : public DensityTerm<OwnQuartic> {
public:
  static constexpr bool depends_on_K = false;

  explicit OwnQuartic(double ld, double lo, std::string name = "own")
      : modulus_{ld, lo, Profile::monotonic}, name_(std::move(name)) {}

  TermName term() const override { return name_; }
  Derivatives needs() const override { return Derivatives::gradient; }
  bool differs_between_phases() const override { return modulus_.differs(); }

  template <class C, class N>
  N density(const Steps<C>& steps, const N& KM, const N&) const {
    return modulus_.at(steps) * (KM * KM * (KM * KM));
  }

private:
  Coefficient modulus_;
  std::string name_;
};

SurfaceTerms own(double ld, double lo) { return {std::make_shared<OwnQuartic>(ld, lo)}; }

Scene small(const char* name) {
  Scene scene = builtin_scene(name);
  scene.nodes = {32, 32, 32};
  return scene;
}

/// After some steps, and what the term comes to.
void expect_same_run(const Scene& without, const SurfaceTerms& terms, const Scene& with) {
  Simulation own(without, terms), built_in(with);
  for (int step = 0; step < 5; step++) {
    own.step(with.end());
    built_in.step(with.end());
  }
  const Measures a = own.measures(), b = built_in.measures();
  const double energy = b.terms.value(Term::quartic);
  EXPECT_GT(energy, 0.01 * b.energy);
  EXPECT_NEAR(a.terms.others().at("own"), energy, 1e-10 * energy);
  EXPECT_NEAR(a.energy, b.energy, 1e-10 * b.energy);
  EXPECT_NEAR(a.time, b.time, 1e-10 * b.time);
  EXPECT_NEAR(a.max_speed, b.max_speed, 1e-7 * b.max_speed);
}

TEST(OutsideTerm, ActsAsOneThatIsBuiltIn) {
  const Scene without = small("fig3_oblate");
  Scene with = without;
  with.membrane.quartic_modulus = 0.01;
  expect_same_run(without, own(0.01, 0.01), with);
}

/// Before and after spontaneous curvature sets in.
TEST(OutsideTerm, ActsInTwoPhases) {
  Scene without = small("fig9");
  without.ld.spontaneous_curvature = -1;
  without.curvature_start_time = 2e-6;
  Scene with = without;
  with.ld.quartic_modulus = 0.02;
  with.lo.quartic_modulus = 0.005;
  expect_same_run(without, own(0.02, 0.005), with);
}

TEST(OutsideTerm, HasAColumn) {
  Simulation simulation(small("fig3_oblate"), own(0.01, 0.01));
  const std::filesystem::path file = ::testing::TempDir() + "outside_term_history.csv";
  HistoryWriter(file, simulation.measures()).add(simulation.measures());
  const std::vector<Measures> history = read_history(file);
  ASSERT_EQ(history.size(), 1u);
  EXPECT_GT(*value_of(history[0], "energy_of_own"), 1);
  EXPECT_NEAR(history[0].terms.others().at("own"), simulation.measures().terms.others().at("own"),
              1e-10 * history[0].energy);
  EXPECT_NEAR(history[0].terms.sum(), history[0].energy, 1e-9 * history[0].energy);
}

TEST(OutsideTerm, MustBeThereWhereARunGoesOn) {
  const Scene scene = small("fig3_oblate");
  const SurfaceTerms terms = own(0.01, 0.01);
  Simulation simulation(scene, terms);
  simulation.step(scene.end());
  const SimulationState state = simulation.state();
  Simulation again(scene, state, terms);
  simulation.step(scene.end());
  again.step(scene.end());
  EXPECT_EQ(again.measures().energy, simulation.measures().energy);
  EXPECT_THROW(Simulation(scene, state), RunError);
}

TEST(OutsideTerm, HasANameThatAColumnMayHave) {
  SurfaceEnergy energy{SurfaceModuli{}};
  for (const char* name : {"", "4th", "a b", "a,b", "Größe"})
    EXPECT_THROW(energy.add(std::make_shared<OwnQuartic>(1, 1, name)), std::invalid_argument);
  EXPECT_NO_THROW(energy.add(std::make_shared<OwnQuartic>(1, 1, "K_M_4th")));
}

} // namespace
} // namespace lamella
