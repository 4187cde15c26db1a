// What a run says at its end.
#include "summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace lamella {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

Measures state_with_phases() {
  Measures m;
  m.energy = 50;
  m.sigma = -7;
  m.phases = {.bending_energy_Ld = 15.5,
              .bending_energy_Lo = 22.25,
              .line_energy = 12.5,
              .sigma_Ld = -3.5,
              .sigma_Lo = -9.25,
              .area_Ld = 1.5,
              .area_Lo = 4,
              .line_length = 2.5,
              .line_radius = 0.125,
              .domains_Ld = 12,
              .domains_Lo = 1};
  return m;
}

std::string summary_of(const Measures& start, const Measures& end) {
  Course course(start);
  course.add(end);
  return summary(Scene(), course, {}, {}, false, 1);
}

TEST(Summary, tells_of_both_phases_and_their_boundary) {
  Measures end = state_with_phases();
  end.phases->bending_energy_Ld = 9.5;
  end.phases->sigma_Lo = -8.25;
  end.phases->line_length = 1.75;
  end.phases->domains_Ld = 3;
  const std::string text = summary_of(state_with_phases(), end);
  EXPECT_THAT(text, AllOf(ContainsRegex("bending +of Ld +15.5 +9.5\n +of Lo +22.25 +22.25\n"),
                          ContainsRegex("phase boundary +12.5 +12.5\n"),
                          ContainsRegex("tension +sigma_Ld +-3.5 +-3.5\n"),
                          ContainsRegex(" sigma_Lo +-9.25 +-8.25\n"),
                          ContainsRegex("area +A_Ld +1.5 +1.5 +fixed\n"),
                          ContainsRegex("phase boundary +length +2.5 +1.75\n"),
                          ContainsRegex("domains +of Ld +12 +3\n +of Lo +1 +1\n")));
  EXPECT_THAT(text, Not(HasSubstr(" -7"))) << "the mean tension, which says nothing more";
}

TEST(Summary, compares_what_the_energy_lost_with_what_was_dissipated) {
  Measures start, end;
  start.energy = 60;
  start.balance.emplace();
  end.energy = 50;
  end.balance = {.work = 2, .dissipated = 12.06};
  EXPECT_THAT(summary_of(start, end),
              HasSubstr("Energy law: 12 lost, 12.06 dissipated (+0.50 %)\n"));
  end.genus = 1; // what a cut did to the energy is no step's
  EXPECT_THAT(summary_of(start, end), Not(HasSubstr("Energy law")));
  end.genus = 0;
  end.energy = start.energy;
  end.balance = {.work = 0, .dissipated = 1e-12};
  EXPECT_THAT(summary_of(start, end), Not(HasSubstr("Energy law"))) << "nothing was lost";
}

TEST(Summary, keeps_its_columns_in_line) {
  Measures state = state_with_phases();
  state.stretch = {0.99, 1.01};
  state.terms[Term::stretch] = 0.5;
  state.terms[Term::film] = 0.25;
  state.terms[Term::normal] = -2.5;
  std::istringstream lines(summary_of(state, state));
  std::string line;
  while (std::getline(lines, line) && !line.ends_with("           end")) {
  }
  const std::size_t width = line.size();
  int rows = 0;
  for (; std::getline(lines, line) && !line.empty(); ++rows) {
    EXPECT_TRUE(line.size() == width || line.substr(width, 3) == "   ") << line;
    EXPECT_NE(line[width - 1], ' ') << line;
  }
  EXPECT_EQ(rows, 27);
}

TEST(Summary, tells_bending_beside_other_terms) {
  Measures state;
  state.terms[Term::bending] = 4.5;
  EXPECT_THAT(summary_of(state, state), Not(HasSubstr("bending"))) << "the whole energy";
  state.terms[Term::mixed_cubic] = -1.25;
  EXPECT_THAT(summary_of(state, state), ContainsRegex("bending +4.5 +4.5\n +mixed cubic +KM K "
                                                      "+-1.25 +-1.25\n"));
}

TEST(Summary, says_nothing_of_phases_where_there_is_one) {
  Measures state;
  state.sigma = -7;
  const std::string text = summary_of(state, state);
  EXPECT_THAT(text, ContainsRegex("tension +sigma +-7 +-7\n"));
  for (const char* word : {"Ld", "Lo", "domains", "stretch", "phase"})
    EXPECT_THAT(text, Not(HasSubstr(word)));
}

TEST(Summary, tells_the_largest_drift_of_any_area) {
  Measures drifted = state_with_phases();
  drifted.area_drift = 1e-6;
  drifted.phases->area_Ld_drift = -3e-5;
  Course course(state_with_phases());
  course.add(drifted);
  course.add(state_with_phases());
  EXPECT_EQ(course.area_drift(), 3e-5);
}

} // namespace
} // namespace lamella
