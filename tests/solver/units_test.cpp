// Units of scene keys and of measures, and scenes in other units.
#include "scene/keys.h"
#include "scene/units.h"
#include "store/history.h"

#include <gtest/gtest.h>

namespace lamella {
namespace {

constexpr UnitChange change{.length = 2, .energy = 3};

TEST(Units, AreProductsOfPowers) {
  EXPECT_EQ(change.factor("length"), 2);
  EXPECT_EQ(change.factor("energy/length²"), 3. / 4);
  EXPECT_EQ(change.factor("energy/length³"), 3. / 8);
  EXPECT_EQ(change.factor("1/length"), 1. / 2);
  EXPECT_EQ(change.factor("length²"), 4);
}

TEST(Units, OfTimeFollowFromADragOfOne) {
  EXPECT_EQ(change.factor("time"), 16. / 3);
  EXPECT_EQ(change.factor("length/time"), 2. / 16 * 3);
  EXPECT_EQ(change.factor("energy time/length⁴"), 1); // the drag itself
}

TEST(Units, DoNotChangeWhatHasNone) {
  for (const char* unit : {"", "degrees", "grid spacings", "seconds"})
    EXPECT_EQ(change.factor(unit), 1) << unit;
}

TEST(Units, OfScenesAreThoseOfTheirKeys) {
  Scene scene;
  scene.shape.center = {0.1, 0, 0};
  scene.volume.ramp.start_times = {0, 0.5};
  const Scene other = in_units(scene, change);
  EXPECT_EQ(other.half_width, 2 * scene.half_width);
  EXPECT_EQ(other.shape.center[0], 0.2);
  EXPECT_EQ(other.membrane.bending_modulus, 3 * scene.membrane.bending_modulus);
  EXPECT_EQ(other.volume.ramp.start_times[1], 0.5 * 16 / 3);
  EXPECT_EQ(other.nodes, scene.nodes);
  EXPECT_EQ(other.shape.reduced_volume, scene.shape.reduced_volume);
}

/// Units that UnitChange understands.
bool is_known(std::string_view unit) {
  return unit.empty() || unit == "degrees" || unit == "grid spacings" || unit == "seconds" ||
         UnitChange{7, 1}.factor(unit) != 1 || UnitChange{1, 7}.factor(unit) != 1;
}

TEST(Units, OfAllKeysAndColumnsAreKnown) {
  for (const Key& key : scene_keys()) EXPECT_TRUE(is_known(key.unit)) << key.path();
  Measures measures;
  measures.phases.emplace();
  measures.stretch.emplace();
  for (const Field& field : row_of(measures)) EXPECT_TRUE(is_known(field.unit)) << field.column;
}

} // namespace
} // namespace lamella
