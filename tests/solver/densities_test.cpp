// Energy densities that a scene gives as text, and the numbers that they name.
#include "error.h"
#include "scene/densities.h"
#include "scene/keys.h"
#include "scene/scene_toml.h"
#include "scene/units.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lamella {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

const std::string one_phase = R"([shape]
kind = "prolate"
[membrane]
density = "0.002*KM^2*K + a*(KM - C0)^2"
[parameters]
a = 3
C0 = -2.5
)";

const std::string two_phases = R"([shape]
kind = "oblate"
[domains]
kind = "cap"
[ld]
density = "a*KM^4"
[lo]
density = "b*K"
[line]
tension = 1
density = "a*kg^2"
[parameters]
a = 0.1
b = 2
)";

Scene scene_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_scene(text, "my.toml", overrides);
}

std::string refusal(std::string text, const std::string& part = "", const std::string& by = "",
                    const std::vector<std::string>& overrides = {}) {
  if (!part.empty()) text.replace(text.find(part), part.size(), by);
  try {
    scene_of(text, overrides);
  } catch (const SceneError& e) {
    return e.what();
  }
  return "accepted";
}

double value(const SceneFormula& density, const std::vector<double>& variables) {
  std::vector<double> results(1), registers;
  read_formula(density.text, density.names).tape.evaluate<double>(variables, results, registers);
  return results.front();
}

TEST(Densities, AreReadWithTheirParameters) {
  const Scene scene = scene_of(one_phase);
  EXPECT_EQ(scene.membrane.density, "0.002*KM^2*K + a*(KM - C0)^2");
  EXPECT_THAT(scene.parameters, ElementsAre(Pair("C0", -2.5), Pair("a", 3)));
  const std::vector<SceneFormula> densities = densities_of(scene);
  ASSERT_EQ(densities.size(), 1);
  EXPECT_EQ(densities[0].key, "membrane.density");
  EXPECT_DOUBLE_EQ(value(densities[0], {-2, 1}), 0.008 + 3 * 0.25);

  std::vector<std::string> keys;
  for (const SceneFormula& density : densities_of(scene_of(two_phases)))
    keys.push_back(density.key);
  EXPECT_THAT(keys, ElementsAre("ld.density", "lo.density", "line.density"));
  EXPECT_TRUE(densities_of(Scene{}).empty());
}

TEST(Densities, AreWrittenAsTheyAreReadAgain) {
  for (const std::string& text : {one_phase, two_phases}) {
    const Scene scene = scene_of(text);
    EXPECT_EQ(parse_scene(to_toml(scene), "my.toml"), scene) << to_toml(scene);
  }
  Scene scene = scene_of(one_phase);
  scene.membrane.density = "a*KM\n  + \tC0*K";
  scene.parameters["a"] = 1. / 3;
  EXPECT_EQ(parse_scene(to_toml(scene), "my.toml"), scene) << to_toml(scene);
  EXPECT_THAT(to_toml(Scene{}), testing::Not(HasSubstr("[parameters]")));
}

TEST(Densities, ParametersCanBeSetOnTheCommandLine) {
  const Scene scene = scene_of(
      one_phase, {"parameters.a=4", "parameters.b = 0.5", "membrane.density=a*KM^4 + C0*b"});
  EXPECT_EQ(scene.membrane.density, "a*KM^4 + C0*b");
  EXPECT_THAT(scene.parameters, ElementsAre(Pair("C0", -2.5), Pair("a", 4), Pair("b", 0.5)));
  EXPECT_EQ(refusal(one_phase, "", "", {"parameters.w=1"}),
            "--set parameters.w=1: [parameters] w: no density speaks of it; allowed: numbers that "
            "density in [membrane], [ld], [lo] or [line] speaks of, or where a field starts");
}

TEST(Densities, MistakesAreToldWithTheirPlaces) {
  EXPECT_EQ(refusal(one_phase, "(KM - C0)", "(KN - C0)"),
            "my.toml:4: [membrane] density: column 19: unknown name KN; allowed: KM, K, C0, a, pi; "
            "did you mean \"KM\"?");
  EXPECT_THAT(refusal(one_phase, "C0)^2", "C0))^2"),
              HasSubstr("my.toml:4: [membrane] density: column 27: a closing bracket"));
  EXPECT_THAT(refusal(one_phase, "a = 3\n", ""),
              HasSubstr("my.toml:4: [membrane] density: column 16: unknown name a; allowed"));
  EXPECT_THAT(refusal(one_phase, "(KM - C0)", "(KM)"),
              HasSubstr("my.toml:7: [parameters] C0: no density speaks of it"));
  EXPECT_THAT(refusal("[parameters]\na = 1\n"),
              HasSubstr("my.toml:2: [parameters] a: no density speaks of it"));
  EXPECT_THAT(refusal(two_phases, "a*kg^2", "a*KM"),
              HasSubstr("my.toml:11: [line] density: column 3: unknown name KM; allowed: kg, kn, "
                        "tau_g, a, b, pi"));
  EXPECT_THAT(refusal(two_phases, "[ld]", "[membrane]"),
              HasSubstr("my.toml:6: [membrane] density: belongs to"));
  EXPECT_THAT(refusal(one_phase, "density = \"0.002*KM^2*K + a*(KM - C0)^2\"", "density = 2"),
              HasSubstr("my.toml:4: [membrane] density: the integer 2 does not fit; allowed: a "
                        "text in quotes"));
}

TEST(Densities, ParametersAreNumbersOfFreeNames) {
  for (const char* name : {"KM", "K", "kg", "tau_g", "sin", "pi", "\"a b\"", "a-b", "1a", "\"\""})
    EXPECT_THAT(refusal(one_phase, "a = 3", std::string(name) + " = 3"),
                HasSubstr("cannot name a number; allowed: letters, digits and _"))
        << name;
  EXPECT_EQ(refusal(one_phase, "a = 3", "a = \"3\""),
            "my.toml:6: [parameters] a: the text \"3\" does not fit; allowed: a number from -1e+30 "
            "to 1e+30");
  EXPECT_EQ(refusal(one_phase, "a = 3", "a = 1e31"),
            "my.toml:6: [parameters] a: 1e+31 is out of range; allowed: a number from -1e+30 to "
            "1e+30");
  EXPECT_THAT(refusal(one_phase, "a = 3", "a = nan"),
              HasSubstr("my.toml:6: [parameters] a: nan is not a finite number"));
  EXPECT_THAT(refusal(one_phase, "a = 3", "a.b = 3"), HasSubstr("[parameters] a: a section"));
  EXPECT_THAT(refusal("parameters = 3"), HasSubstr("my.toml:1: parameters: this is a section"));
}

constexpr const char* with_fields = R"([grid]
nodes = 32
[membrane]
density = "a*s + m^2"
[parameters]
a = 3
[[fields]]
name = "s"
start = "a + x"
[[fields]]
name = "m"
start = "z"
carried = "amount"
)";

TEST(MaterialFields, AreTablesOfTheirOwn) {
  const Scene scene = scene_of(with_fields);
  const MaterialFields expected{{"s", "a + x", Carried::value}, {"m", "z", Carried::amount}};
  EXPECT_EQ(scene.fields, expected);
  EXPECT_EQ(scene_of(to_toml(scene)).fields, expected);
  EXPECT_EQ(parse_fields(text_of(scene.fields)), expected);
  EXPECT_TRUE(parse_fields("").empty());
  const std::string overrides[]{R"(fields=[{name = "s", start = "y"}])", "membrane.density=a*s"};
  EXPECT_EQ(parse_scene(with_fields, "my.toml", overrides).fields,
            (MaterialFields{{"s", "y", Carried::value}}));
}

TEST(MaterialFields, ThatCannotBeAreRefused) {
  const auto refused = [](const char* what, const char* by) {
    return refusal(with_fields, what, by);
  };
  EXPECT_EQ(refused("carried = \"amount\"", "carried = \"both\""),
            "my.toml:7: [[fields]] carried of field 2: the text \"both\" does not fit; allowed: "
            "\"value\", \"amount\"");
  EXPECT_EQ(refused("carried", "caried"), "my.toml:7: [[fields]] caried: unknown key; allowed: "
                                          "name, start, carried; did you mean \"carried\"?");
  EXPECT_THAT(refused("name = \"m\"", "name = 3"),
              HasSubstr("[[fields]] name of field 2: the integer 3 does not fit; allowed: a text"));
  EXPECT_THAT(refused("name = \"m\"", "name = \"s\""), HasSubstr("the name s is given twice"));
  for (const char* name : {"KM", "x", "kg", "psi", "c", "phi", "K_M", "sin", "a b", ""})
    EXPECT_THAT(refused("name = \"m\"", fmt::format("name = \"{}\"", name).c_str()),
                HasSubstr("cannot name a field; allowed: letters, digits and _"))
        << name;
  EXPECT_THAT(refused("name = \"m\"", "name = \"a\""), HasSubstr("the name a is given twice"));
  EXPECT_THAT(refused("a*s + m^2", "a*s"), HasSubstr("no density speaks of m; allowed: fields"));
  EXPECT_THAT(
      refused("start = \"z\"", "start = \"zz\""),
      HasSubstr("m starts from an array \"zz\", and there is no frame; allowed: a formula"));
  EXPECT_THAT(refused("start = \"z\"", "start = \"z +\""), HasSubstr("my.toml:7: fields: "));
  EXPECT_THAT(refused("[grid]", "[stretch]\nmodulus = 3\n[grid]"),
              HasSubstr("where lipid flows along the membrane"));
  EXPECT_THAT(refusal("fields = 3"), HasSubstr("my.toml:1: fields: the integer 3 does not fit"));
  EXPECT_THAT(refusal("fields = [3]"), HasSubstr("my.toml:1: fields: a list of 1 does not fit"));
  EXPECT_THAT(refusal("[line]\ndensity = \"kg\"\n[fields]\nname = \"s\""), HasSubstr("my.toml:3"));
}

TEST(MaterialFields, AreTheSameInOtherUnits) {
  const Scene other = in_units(scene_of(with_fields), {.length = 2, .energy = 3});
  ASSERT_EQ(other.fields.size(), 2u);
  const SceneFormula start = starts_of(other)[0], before = starts_of(scene_of(with_fields))[0];
  EXPECT_DOUBLE_EQ(value(start, {0.6, 0, 0}), value(before, {0.3, 0, 0}));
}

TEST(Densities, AreTheSameInOtherUnits) {
  const UnitChange change{.length = 2, .energy = 3};
  const SceneFormula before = densities_of(scene_of(one_phase))[0],
                     after = densities_of(in_units(scene_of(one_phase), change))[0];
  EXPECT_DOUBLE_EQ(value(after, {-1.5 / 2, 0.7 / 4}), value(before, {-1.5, 0.7}) * 3 / 4);
  EXPECT_NO_THROW(scene_of(to_toml(in_units(scene_of(one_phase), change))));
}

TEST(Parameters, AreAListInOneLine) {
  EXPECT_THAT(parse_parameters("a = 3, C0 = -2.5"), ElementsAre(Pair("C0", -2.5), Pair("a", 3)));
  EXPECT_TRUE(parse_parameters(" ").empty());
  Scene scene;
  scene.parameters = {{"a", 3}, {"C0", -2.5}};
  EXPECT_EQ(value_text(*find_key("parameters", "any"), scene), "C0 = -2.5, a = 3");
  for (const char* text :
       {"a", "a = ", "a = \"b\"", "a = 1, a = 2", "a = 1}\nb = {c = 2", "a = {b = 1}"})
    EXPECT_THROW(parse_parameters(text), SceneError) << text;
}

} // namespace
} // namespace lamella
