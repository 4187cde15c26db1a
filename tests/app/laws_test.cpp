// The random scenes of `lamella extremes --random`, and that some of them obey the laws of every
// run.
#include "extremes/laws.h"
#include "extremes/random_scene.h"
#include "extremes/report.h"
#include "scene/scene_toml.h"

#include <gtest/gtest.h>

#include <set>

namespace lamella {
namespace {

TEST(RandomScenes, AreTheSameForTheSameNumbers) {
  EXPECT_EQ(random_scene(1, 7), random_scene(1, 7));
  EXPECT_NE(random_scene(1, 7), random_scene(2, 7));
  EXPECT_NE(random_scene(1, 7), random_scene(1, 8));
}

TEST(RandomScenes, AreWhatTheirFilesSay) {
  for (int number = 1; number <= 20; number++) {
    const Scene scene = random_scene(3, number);
    EXPECT_EQ(parse_scene(to_toml(scene), scene.name), scene) << number;
  }
}

TEST(RandomScenes, AreOfAllKinds) {
  std::set<ShapeKind> shapes;
  int two_phases = 0, ramped = 0, stretched = 0, turned = 0;
  for (int number = 1; number <= 60; number++) {
    const Scene scene = random_scene(1, number);
    shapes.insert(scene.shape.kind);
    two_phases += scene.has_phases();
    ramped += scene.volume.constraint == Constraint::ramped;
    stretched += scene.stretch.modulus > 0;
    turned += scene.shape.rotation_angle != 0;
  }
  EXPECT_EQ(shapes.size(), 5u);
  for (const int count : {two_phases, ramped, stretched, turned}) EXPECT_GT(count, 3);
}

class Laws : public testing::TestWithParam<int> {};

TEST_P(Laws, HoldForRandomScenes) {
  const LawReport report = check_laws(random_scene(1, GetParam()), [] { return true; });
  EXPECT_TRUE(report.broken.empty()) << law_text(report) << to_toml(report.run.scene);
}

INSTANTIATE_TEST_SUITE_P(Seed1, Laws, testing::Range(1, 7));

} // namespace
} // namespace lamella
