#include "error.h"
#include "nearest.h"
#include "scene/builtin.h"
#include "scene/keys.h"
#include "scene/scene_toml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace lamella {
namespace {

using testing::HasSubstr;
using Overrides = std::vector<std::string>;

std::string content_of(const std::string& file) {
  std::ifstream stream(file);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const SceneError& error) {
    return error.what();
  }
  return "no SceneError";
}

Scene scene_of_kind(ShapeKind kind) {
  Scene scene;
  scene.shape.kind = kind;
  return scene;
}

TEST(Scene, CanBeThreeLinesLong) {
  const Scene scene =
      parse_scene("[shape]\nkind = \"sphere\"\nradius = 0.6\n", "folder/my.vesicle.toml");
  Scene expected = scene_of_kind(ShapeKind::sphere);
  expected.name = "my.vesicle";
  expected.shape.radius = 0.6;
  EXPECT_EQ(scene, expected);
}

TEST(Scene, TakesEveryKeyOfTheFormat) {
  const Scene scene = parse_scene(R"(
name = "run-7"
title = "A \"quoted\" title, µm"
grid = { nodes = [64, 72, 96], half_width = 2 }
[shape]
kind = "ellipsoid"
semi_axes = [0.9, 1, 1.1]
center = [0.1, 0, -0.2]
rotation_axis = [1, 2, 3]
rotation_angle = -30.5
[membrane]
bending_modulus = 20
spontaneous_curvature = -1.5
[perturbation]
amplitude = 0.01
wavelength = 0.25
seed = 7
fold = 0
[volume]
constraint = "ramped"
targets = [0.95, 0.9]
start_times = [0, 1e-3]
rate = 20
[area_difference]
constraint = "free"
multiplier = 12
[contact]
topology_changes = false
disjoining_pressure = 1e3
disjoining_range = 0.01
rupture_thickness = 0.05
[stop]
energy_rate = 1e-3
residual_force = 0.1
topology_changes = 4
wall_time = 3600
[run]
end_time = 2e-2
[numerics]
tolerance = 0.01
max_time_step = 1e-4
[output]
frames = 5
)",
                                  "scene.toml");
  Scene expected = scene_of_kind(ShapeKind::ellipsoid);
  expected.name = "run-7";
  expected.title = "A \"quoted\" title, µm";
  expected.nodes = {64, 72, 96};
  expected.half_width = 2;
  expected.shape.semi_axes = {0.9, 1, 1.1};
  expected.shape.center = {0.1, 0, -0.2};
  expected.shape.rotation_axis = {1, 2, 3};
  expected.shape.rotation_angle = -30.5;
  expected.perturbation = {.amplitude = 0.01, .wavelength = 0.25, .seed = 7, .fold = 0};
  expected.membrane = {20, -1.5};
  expected.volume.constraint = Constraint::ramped;
  expected.volume.ramp = {.targets = {0.95, 0.9}, .start_times = {0, 1e-3}, .rate = 20};
  expected.area_difference.multiplier = 12;
  expected.contact = {.topology_changes = false,
                      .disjoining_pressure = 1e3,
                      .disjoining_range = 0.01,
                      .rupture_thickness = 0.05};
  expected.stop = {
      .energy_rate = 1e-3, .residual_force = 0.1, .topology_changes = 4, .wall_time = 3600};
  expected.end_time = 2e-2;
  expected.numerics = {0.01, 1e-4};
  expected.output.frames = 5;
  EXPECT_EQ(scene, expected);
  EXPECT_DOUBLE_EQ(scene.grid().spacing, 4.0 / 64);
  EXPECT_DOUBLE_EQ(scene.grid().length(2), 6);
}

TEST(Scene, TakesEveryKeyOfTwoPhases) {
  const Scene scene = parse_scene(R"(
[shape]
kind = "sphere"
[domains]
kind = "caps"
directions = [[0, 0, 2], [1, -1, 0.5]]
half_angle = 25
bulge = -30
curvature_start_time = 1e-3
[ld]
bending_modulus = 2
spontaneous_curvature = -3
gaussian_modulus = 3.6
[lo]
bending_modulus = 10
spontaneous_curvature = 4
gaussian_modulus = -1
[line]
tension = 30
geodesic_modulus = 0.1
torsion_modulus = -0.2
normal_modulus = 0.3
geodesic_square_modulus = 0.4
torsion_square_modulus = 0.5
normal_square_modulus = 0.6
[stretch]
modulus = 1000
)",
                                  "scene.toml");
  Scene expected = scene_of_kind(ShapeKind::sphere);
  expected.name = "scene";
  expected.domains = {.kind = DomainsKind::caps,
                      .directions = {{0, 0, 2}, {1, -1, 0.5}},
                      .half_angle = 25,
                      .bulge = -30};
  expected.curvature_start_time = 1e-3;
  expected.ld = {2, -3, 3.6};
  expected.lo = {10, 4, -1};
  expected.line = {30, 0.1, -0.2, 0.3, 0.4, 0.5, 0.6};
  expected.stretch.modulus = 1000;
  EXPECT_EQ(scene, expected);
}

TEST(Scene, IsTheSameAfterWritingAndReadingWithDomains) {
  for (const char* name : {"fig9", "fig12_kl5_C-5", "fig13b", "fig14", "fig15b", "baumgart_0.18"}) {
    const Scene scene = builtin_scene(name);
    EXPECT_EQ(parse_scene(to_toml(scene), "other.toml"), scene) << to_toml(scene);
  }
  const Scene frame = parse_scene("[shape]\nkind = \"frame\"\nfile = \"run\"\n[domains]\nkind = "
                                  "\"frame\"\nfile = \"other\"\n",
                                  "scene.toml");
  EXPECT_EQ(frame.domains.file, "other");
  EXPECT_EQ(parse_scene(to_toml(frame), "other.toml"), frame);
}

TEST(Scene, IsTheSameAfterWritingAndReading) {
  for (const char* kind : {"sphere", "oblate", "prolate", "ellipsoid", "torus"}) {
    const Overrides changes{std::string("shape.kind=") + kind, "title=some \"quotes\" \\ here",
                            "shape.center=[0.1, 0.01, 1e-17]", "run.end_time=0.1234567890123456",
                            "grid.nodes=[64, 96, 72]",         "shape.rotation_angle=33.3"};
    const Scene scene = builtin_scene("fig3_oblate", changes);
    EXPECT_EQ(parse_scene(to_toml(scene), "other.toml"), scene) << to_toml(scene);
  }
}

TEST(Scene, IsTheSameAfterWritingAndReadingUnderEveryConstraint) {
  for (const char* name : {"fig7b", "fig8b", "fig8e"}) {
    const Scene scene = builtin_scene(name);
    EXPECT_EQ(parse_scene(to_toml(scene), "other.toml"), scene) << to_toml(scene);
  }
}

TEST(Scene, TakesASingleTargetFromTheStart) {
  const Scene scene =
      parse_scene("[volume]\nconstraint = \"ramped\"\ntargets = 0.55\n", "scene.toml");
  EXPECT_EQ(scene.volume.ramp.targets, std::vector{0.55});
  EXPECT_EQ(scene.volume.ramp.start_times, std::vector{0.0});
}

TEST(Scene, OfAFrameIsAsValidAsItsFileWillProve) {
  const Scene scene = parse_scene(
      "[shape]\nkind = \"frame\"\nfile = \"run\"\n[grid]\nhalf_width = 100\n", "scene.toml");
  EXPECT_EQ(scene.shape.file, "run");
}

TEST(Scene, OfACurvatureThatTheMultiplierMakesUpForIsResolved) {
  EXPECT_NO_THROW(parse_scene(
      "[membrane]\nspontaneous_curvature = -40\n[area_difference]\nmultiplier = -60\n", "x.toml"));
}

TEST(Scene, WritesWhatCountsAndOnlyThat) {
  const std::string text = to_toml(scene_of_kind(ShapeKind::torus));
  EXPECT_THAT(text, HasSubstr("ring_radius = 0.5"));
  EXPECT_THAT(text, HasSubstr("radius of the tube (length)"));
  EXPECT_THAT(text, Not(HasSubstr("semi_axis")));
  EXPECT_THAT(text, HasSubstr("[membrane]"));
  for (const char* section : {"[ld]", "[lo]", "[line]"}) EXPECT_THAT(text, Not(HasSubstr(section)));
  const std::string two_phases = to_toml(builtin_scene("fig13b"));
  EXPECT_THAT(two_phases, HasSubstr("[ld]\nbending_modulus = 1 "));
  EXPECT_THAT(two_phases, HasSubstr("[line]\ntension = 20 "));
  EXPECT_THAT(two_phases, Not(HasSubstr("[membrane]")));
}

TEST(Overrides, ReplaceTheFileAndTheLastOneWins) {
  const Overrides changes{"grid.nodes=96", "grid.nodes = 128", "title=My own run", "name=x_1",
                          "output.frames=3"};
  const Scene scene = builtin_scene("fig3_prolate", changes);
  EXPECT_EQ(scene.nodes, (std::array{128, 128, 128}));
  EXPECT_EQ(scene.title, "My own run");
  EXPECT_EQ(scene.name, "x_1");
  EXPECT_EQ(scene.output.frames, 3);
  EXPECT_EQ(scene.shape.reduced_volume, 0.6);
}

TEST(Overrides, TakeBareWordsAndTomlTextsAlike) {
  const Overrides bare{"shape.kind=sphere"}, in_quotes{"shape.kind=\"sphere\""};
  EXPECT_EQ(builtin_scene("fig3_oblate", bare), builtin_scene("fig3_oblate", in_quotes));
}

TEST(Overrides, OfTheKindDropTheKeysOfTheOldShape) {
  const Overrides changes{"shape.kind=torus", "shape.tube_radius=0.15"};
  const Scene scene = builtin_scene("fig3_oblate", changes);
  EXPECT_EQ(scene.shape.kind, ShapeKind::torus);
  EXPECT_EQ(scene.shape.tube_radius, 0.15);
}

TEST(Overrides, OfAConstraintDropTheKeysOfTheOldOne) {
  const Overrides changes{"area_difference.constraint=free", "area_difference.multiplier=3",
                          "volume.constraint=fixed"};
  const Scene scene = builtin_scene("fig8b", changes);
  EXPECT_EQ(scene.area_difference.constraint, Constraint::free);
  EXPECT_EQ(scene.area_difference.multiplier, 3);
  EXPECT_EQ(scene.area_difference.ramp, Ramp{});
}

TEST(Overrides, OfTheDomainsDropTheModuliOfTheOldPhases) {
  const Overrides none{"domains.kind=none", "membrane.bending_modulus=2",
                       "perturbation.amplitude=0.02"}; // a sphere needs it
  const Scene one = builtin_scene("fig13b", none);
  EXPECT_EQ(one.membrane.bending_modulus, 2);
  EXPECT_EQ(one.line, Line{});
  EXPECT_EQ(one.stretch.modulus, 1000);
  const Overrides caps{"domains.kind=caps", "domains.directions=[[0, 0, 1], [1, 0, 0]]",
                       "line.tension=3", "volume.constraint=free"};
  const Scene two = parse_scene("[shape]\nkind = \"sphere\"\n[membrane]\nbending_modulus = 2\n",
                                "scene.toml", caps);
  EXPECT_EQ(two.domains.directions, (std::vector<Vec3>{{0, 0, 1}, {1, 0, 0}}));
  EXPECT_EQ(two.membrane, SurfaceModuli{});
}

TEST(Overrides, AreBlamedForTheRuleTheyBreak) {
  const Overrides coarse{"grid.nodes=32"};
  EXPECT_THAT(message_of([&] { builtin_scene("fig3_prolate", coarse); }),
              testing::StartsWith("--set grid.nodes=32: [grid] nodes: the grid is too coarse"));
}

TEST(Builtin, ScenesAreValidAndCarryTheirTitles) {
  ASSERT_GE(builtin_scenes().size(), 34u);
  for (const BuiltinScene& builtin : builtin_scenes()) {
    const Scene scene = builtin_scene(builtin.name);
    EXPECT_EQ(scene.title, builtin.title);
    EXPECT_EQ(scene.name, builtin.name);
    const auto file =
        std::string(LAMELLA_SOURCE_DIR "/data/scenes/") + std::string(builtin.name) + ".toml";
    EXPECT_EQ(read_scene(file), scene);
  }
  EXPECT_TRUE(std::ranges::is_sorted(builtin_scenes(), {}, &BuiltinScene::name));
}

TEST(Builtin, FigureScenesRunOnTheGridsOfTheConvergenceStudies) {
  for (const int nodes : {24, 32, 40, 48, 64, 96, 128, 192}) {
    const Overrides grid{"grid.nodes=" + std::to_string(nodes)};
    EXPECT_NO_THROW(builtin_scene("fig3_oblate", grid)) << nodes;
    if (nodes >= 40) {
      EXPECT_NO_THROW(builtin_scene("fig3_prolate", grid)) << nodes;
    }
  }
}

TEST(Builtin, ScenesOfTwoPhasesRunOnTheGridsOfTable3) {
  for (const int nodes : {48, 64, 80}) {
    const Overrides grid{"grid.nodes=" + std::to_string(nodes)};
    for (const char* name : {"fig9", "fig11_v0.7_kl10", "baumgart_0.95"})
      EXPECT_NO_THROW(builtin_scene(name, grid)) << name << nodes;
  }
}

TEST(Builtin, UnknownNameSuggestsTheNearest) {
  EXPECT_THAT(message_of([] { builtin_scene("fig3_oblat"); }),
              HasSubstr("did you mean \"fig3_oblate\"?"));
  EXPECT_THAT(message_of([] { builtin_scene("zzzz"); }), Not(HasSubstr("did you mean")));
}

TEST(Keys, HaveValidDefaultsUniqueNamesAndHelp) {
  Scene scene;
  EXPECT_NO_THROW(validate(scene));
  for (const Key& key : scene_keys()) {
    EXPECT_FALSE(key.help.empty()) << key.path();
    EXPECT_EQ(find_key(key.section, key.name), &key);
  }
}

TEST(Keys, CountForValuesThatTheChoiceOfTheirSectionHas) {
  for (const Key& key : scene_keys()) {
    if (key.cases.empty()) continue;
    const auto& names = std::get<Choice>(choice_key(key.section).access).names;
    EXPECT_THAT(names, testing::IsSupersetOf(key.cases)) << key.path();
  }
}

TEST(Keys, AreDocumented) {
  const std::string docs = content_of(LAMELLA_SOURCE_DIR "/docs/scene-format.md");
  EXPECT_THAT(docs, HasSubstr(describe_keys()))
      << "docs/scene-format.md must hold this, word for word:\n"
      << describe_keys();
}

TEST(Docs, ExamplesAreScenes) {
  const std::string docs = content_of(LAMELLA_SOURCE_DIR "/docs/scene-format.md");
  const std::string opening = "```toml\n";
  int count = 0;
  for (auto at = docs.find(opening); at != docs.npos; at = docs.find(opening, at)) {
    at += opening.size();
    const std::string example = docs.substr(at, docs.find("```", at) - at);
    EXPECT_NO_THROW(parse_scene(example, "example.toml")) << example;
    ++count;
  }
  EXPECT_GE(count, 7);
}

TEST(Nearest, CountsEditsAndKnowsItsLimit) {
  const std::vector<std::string_view> words{"semi_axis", "semi_axes", "center"};
  EXPECT_EQ(nearest("semi_axs", words), "semi_axis");
  EXPECT_EQ(nearest("SEMI_AXES", words), "semi_axes");
  EXPECT_EQ(nearest("cetner", words), "center");
  EXPECT_EQ(nearest("viscosity", words), std::nullopt);
  EXPECT_EQ(nearest("", words), std::nullopt);
}

} // namespace
} // namespace lamella
