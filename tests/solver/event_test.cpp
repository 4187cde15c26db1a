// Events in words.
#include "dynamics/event.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lamella {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using Kind = Event::Kind;

constexpr Kind all_kinds[]{Kind::fission,   Kind::rupture, Kind::fusion,      Kind::vanished,
                           Kind::recentred, Kind::sharp,   Kind::thin_inside, Kind::thin_outside};

TEST(Events, HaveAWordEachThatReadsBack) {
  for (const Kind kind : all_kinds) EXPECT_EQ(event_kind(to_string(kind)), kind);
  EXPECT_EQ(to_string(Kind::thin_inside), "thin_inside");
  EXPECT_FALSE(event_kind("thin"));
  EXPECT_FALSE(event_kind(""));
}

TEST(Events, AreTopologyChangesUnderResolvedOrNeither) {
  const auto marks = [](Kind kind) {
    const Event event{kind};
    return std::pair(event.changes_topology(), event.is_under_resolved());
  };
  for (const Kind kind : {Kind::fission, Kind::rupture, Kind::fusion, Kind::vanished})
    EXPECT_EQ(marks(kind), std::pair(true, false)) << to_string(kind);
  EXPECT_EQ(marks(Kind::recentred), std::pair(false, false));
  for (const Kind kind : {Kind::sharp, Kind::thin_inside, Kind::thin_outside})
    EXPECT_EQ(marks(kind), std::pair(false, true)) << to_string(kind);
}

TEST(Events, TellWhatAChangeOfTopologyDid) {
  Event event{Kind::fission, 2.5125e-4, {0.1, -0.25, -1e-9}, 0.03};
  event.components_before = 1;
  event.components_after = 2;
  event.genus_before = event.genus_after = 3;
  event.area_before = 4;
  event.area_cut = 3.99;
  event.energy_before = 120.5;
  event.energy_after = 96.25;
  EXPECT_EQ(to_text(event, 0.02),
            "t = 0.00025125: a neck of radius 0.03 (1.5 grid spacings) was cut at (0.1, -0.25, 0); "
            "components 1 -> 2, genus 3 -> 3; area changed by -0.25 % and restored; energy 120.5 "
            "-> 96.25");
  event.size = 0; // nothing narrow was seen before
  EXPECT_THAT(to_text(event, 0.02), HasSubstr(": a neck was cut at (0.1, -0.25, 0); components"));
}

TEST(Events, SayHowFarUnderResolvedAndWhatHelps) {
  const Event sharp{Kind::sharp, 1e-3, {0, 0, 0.5}, 0.03};
  EXPECT_EQ(to_text(sharp, 0.02),
            "t = 0.001: the membrane bends with a radius of 0.03 (1.5 grid spacings) at (0, 0, "
            "0.5), sharper than the grid resolves; more grid.nodes help");
  for (const Kind kind : {Kind::thin_inside, Kind::thin_outside})
    EXPECT_THAT(to_text(Event{kind, 1e-3, {0, 0, 0.5}, 0.03}, 0.02),
                AllOf(HasSubstr(" 0.06 (3 grid spacings) "), HasSubstr("more grid.nodes")))
        << "the whole thickness, not half of it";
}

TEST(Events, TellHowTheBoxMoved) {
  Event event{Kind::recentred, 1e-3};
  event.cells = {1, 0, -2};
  EXPECT_EQ(to_text(event, 0.02),
            "t = 0.001: the box moved by (1, 0, -2) cells to follow the vesicle");
}

TEST(Events, AreOneLineEach) {
  for (const Kind kind : all_kinds) EXPECT_THAT(to_text(Event{kind}, 0.1), Not(HasSubstr("\n")));
}

} // namespace
} // namespace lamella
