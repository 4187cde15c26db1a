// Extreme cases: known answers, verdicts, the command, and that no quick case comes out wrong.
#include "cli.h"

#include "error.h"
#include "extremes/known_answer.h"
#include "extremes/report.h"
#include "extremes/verdict.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace lamella {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;
using testing::StartsWith;

/// A vesicle of this reduced volume whose sphere of the same area has this radius.
Measures vesicle(double v, double Rs) {
  Measures m;
  m.area = 4 * std::numbers::pi * Rs * Rs;
  m.volume = v * 4 / 3 * std::numbers::pi * Rs * Rs * Rs;
  m.reduced_volume = v;
  return m;
}

CaseResult ended(Known known, double energy_error, double P_error) {
  CaseResult result;
  result.which = {"a case", "sphere", known};
  result.ending = Ending::ended;
  result.errors.energy = energy_error;
  result.errors.P = P_error;
  return result;
}

Event unresolved() {
  Event event;
  event.kind = Event::Kind::sharp;
  return event;
}

// --------------------------------------------------------------------------------- known answers

TEST(KnownAnswer, ObeysTheVirialTheoremAtAnySize) {
  for (const Known branch : {Known::oblate, Known::prolate})
    for (const double v : {0.99, 0.9, 0.6, 0.5}) {
      const Measures m = vesicle(v, 0.4);
      const ReferenceState exact = known_answer({"", "", branch}, m);
      EXPECT_NEAR(3 * exact.P * m.volume / (2 * exact.sigma * m.area), 1, 1e-8) << v;
      EXPECT_EQ(exact.int_KM2, 2 * exact.energy);
    }
}

TEST(KnownAnswer, OfATubeIsACylinder) {
  const double v = 0.25, radius = 2. / 3 * v;
  const ReferenceState exact = known_answer({"", "", Known::prolate}, vesicle(v, 1));
  EXPECT_NEAR(exact.P, -2 / std::pow(radius, 3), 1e-6);
  EXPECT_NEAR(exact.sigma, -1.5 / std::pow(radius, 2), 1e-6);
}

TEST(KnownAnswer, ComesToTheSphereAlongBothBranches) {
  for (const Known branch : {Known::oblate, Known::prolate}) {
    const double energy = known_answer({"", "", branch}, vesicle(0.99, 1)).energy;
    EXPECT_NEAR(energy, known_answer({"", "sphere", Known::sphere}, {}).energy, 0.6);
  }
}

TEST(KnownAnswer, OfARelaxingVesicleScalesWithItsSize) {
  const ExtremeCase small{"", "fig3_oblate", Known::relaxation};
  Measures end = vesicle(0.6, 0.5);
  end.time = 1e-3;
  const ReferenceState exact = known_answer(small, end);
  Measures twice = vesicle(0.6, 1);
  twice.time = 16e-3;
  const ReferenceState larger = known_answer(small, twice);
  EXPECT_NEAR(exact.int_KM2, larger.int_KM2, 1e-9);
  EXPECT_NEAR(exact.P, 8 * larger.P, 1e-9 * std::abs(exact.P));
}

TEST(KnownAnswer, IsOnlyForVesiclesThatTheTablesHave) {
  EXPECT_THROW(known_answer({"", "", Known::oblate}, vesicle(0.3, 1)), std::logic_error);
}

// -------------------------------------------------------------------------------------- verdicts

TEST(Verdicts, AreRightWithinBounds) {
  EXPECT_EQ(ended(Known::oblate, 2e-4, 1e-2).verdict(), Verdict::right);
  EXPECT_EQ(ended(Known::sphere, 2e-4, NAN).verdict(), Verdict::right) << "P is not known";
  EXPECT_EQ(ended(Known::oblate, 4e-4, 1e-2).verdict(), Verdict::wrong);
  EXPECT_EQ(ended(Known::oblate, 2e-4, 3e-2).verdict(), Verdict::wrong);
  EXPECT_EQ(ended(Known::oblate, NAN, NAN).verdict(), Verdict::wrong);
}

TEST(Verdicts, AreNotRightWhereAreaOrVolumeIsLost) {
  CaseResult result = ended(Known::oblate, 0, 0);
  result.drift = 2e-3;
  EXPECT_EQ(result.verdict(), Verdict::wrong);
}

TEST(Verdicts, CountAWarning) {
  CaseResult result = ended(Known::oblate, 4e-4, 0);
  result.events.push_back(unresolved());
  EXPECT_EQ(result.verdict(), Verdict::warned);
}

TEST(Verdicts, AskForEnergyAndConstraintsWhereNothingIsKnown) {
  CaseResult result = ended(Known::nothing, NAN, NAN);
  EXPECT_EQ(result.verdict(), Verdict::consistent);
  result.energy_rise = 0.01;
  EXPECT_EQ(result.verdict(), Verdict::wrong);
  result.energy_rise = 0;
  result.drift = 0.01;
  EXPECT_EQ(result.verdict(), Verdict::wrong);
}

TEST(Verdicts, AskForAMessage) {
  CaseResult result = ended(Known::oblate, NAN, NAN);
  for (const auto& [ending, verdict] : {std::pair{Ending::stopped, Verdict::stopped},
                                        std::pair{Ending::refused, Verdict::refused}}) {
    result.ending = ending;
    result.message = "the membrane has disappeared";
    EXPECT_EQ(result.verdict(), verdict);
    result.message = "";
    EXPECT_EQ(result.verdict(), Verdict::wrong);
  }
}

TEST(Verdicts, ForgiveNeitherAHangNorANumberThatIsNone) {
  CaseResult result = ended(Known::oblate, 0, 0);
  result.finite = false;
  EXPECT_EQ(result.verdict(), Verdict::wrong);
  result.finite = true;
  result.ending = Ending::hung;
  EXPECT_EQ(result.verdict(), Verdict::wrong);
}

// ----------------------------------------------------------------------------------------- cases

TEST(ExtremeCases, HaveNamesOfTheirOwnAndScenesOrAMessage) {
  std::set<std::string_view> names;
  for (const ExtremeCase& each : extreme_cases()) {
    EXPECT_TRUE(names.insert(each.name).second) << each.name;
    try {
      scene_of(each);
    } catch (const SceneError& e) {
      EXPECT_THAT(e.what(), AllOf(HasSubstr("allowed: "), Not(HasSubstr("unknown")))) << each.name;
    }
  }
}

TEST_F(Cli, writes_the_table_of_extremes) {
  const Result result = call(words("extremes -o out --only sphere"));
  ASSERT_EQ(result.code, 0) << result.err << result.out;
  EXPECT_THAT(names_in(work() / "out"), ElementsAre("extremes.csv", "extremes.md"));
  EXPECT_THAT(text_of(work() / "out" / "extremes.md"),
              AllOf(HasSubstr("1 case: 1 right"), HasSubstr("| sphere | right | 50.26")));
  EXPECT_THAT(
      text_of(work() / "out" / "extremes.csv"),
      AllOf(StartsWith("case,scene,ending,t,"), HasSubstr("\n\"sphere\",\"sphere\",ended,")));
}

TEST_F(Cli, knows_the_names_of_extremes) {
  const Result result = call(words("extremes --only cube"));
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, MatchesRegex("lamella: --only \"cube\": no case[^\n]+\n"));
  EXPECT_THAT(names_in(work()), testing::IsEmpty());
}

TEST_F(Cli, finds_no_quick_extreme_wrong) {
  const Result result = call(words("extremes --quick -o out"));
  EXPECT_EQ(result.code, 0) << result.out;
  EXPECT_THAT(result.out, HasSubstr(", 0 WRONG\n"));
  for (const char* reached : {"oblate v = 0.60", "prolate v = 0.40, deflated", "24^3"})
    EXPECT_THAT(text_of(work() / "out" / "extremes.md"),
                HasSubstr(fmt::format("| {} | right |", reached)));
}

} // namespace
} // namespace lamella
