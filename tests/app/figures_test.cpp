#include "cli.h"
#include "figures/figure_page.h"
#include "figures/outcome.h"
#include "figures/study.h"
#include "scene/builtin.h"
#include "scene/scene_toml.h"
#include "scene/units.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace lamella {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// ------------------------------------------------------------------------------- figures' files

std::string error_of(const std::string& text) {
  try {
    parse_figure(text, "mine.toml");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

TEST(FigureFile, SaysWhatIsWrongAndWhereAndWhatIsRight) {
  const std::string panel = "[[panel]]\nscene = \"fig9\"\n";
  EXPECT_THAT(error_of("title = \"x\"\n"), HasSubstr("no panel"));
  EXPECT_THAT(error_of("titel = \"x\"\n" + panel),
              AllOf(HasSubstr("mine.toml:1: titel: unknown key"), HasSubstr("\"title\"?")));
  EXPECT_THAT(error_of(panel + "tims = [0]\n"),
              AllOf(HasSubstr("mine.toml:3: [panel] tims: unknown key; allowed: kind"),
                    HasSubstr("\"times\"?")));
  EXPECT_THAT(error_of("[[panel]]\ntimes = [0]\n"),
              AllOf(HasSubstr("[panel] scene: is missing"), HasSubstr("built-in scene")));
  EXPECT_THAT(error_of(panel + "times = [2, 1]\n"),
              AllOf(HasSubstr("mine.toml:3: [panel] times"), HasSubstr("ascending")));
  EXPECT_THAT(error_of(panel + "times = \"end\"\n"), HasSubstr("mine.toml:3: [panel] times"));
  EXPECT_THAT(error_of(panel + "color = \"K_m\"\n"),
              AllOf(HasSubstr("\"energy_density\""), HasSubstr("did you mean \"K_M\"?")));
  EXPECT_THAT(error_of(panel + "kind = \"movie\"\n"), HasSubstr("\"convergence\""));
  EXPECT_THAT(error_of(panel + "elevation = 120\n"), HasSubstr("-90 to 90"));
  EXPECT_THAT(error_of("columns = 2\n" + panel + "span = 3\n"), HasSubstr("1 to 2"));
  EXPECT_THAT(error_of(panel + "expect = { arms = [4, 3] }\n"), HasSubstr("[least, most]"));
  EXPECT_THAT(error_of("[[panel]]\nkind = \"table\"\nscene = \"fig9\"\nvary = \"grid.nodes\"\n"
                       "values = [48, 64]\nquantities = [\"P\"]\npaper = [[1]]\n"),
              HasSubstr("[panel] paper"));
  const std::string plot = "[[panel]]\nkind = \"plot\"\nscenes = [\"fig9\", \"fig14\"]\n";
  EXPECT_THAT(error_of(plot + "y = \"presure\"\n"), HasSubstr("columns of history.csv"));
  EXPECT_THAT(error_of(plot + "y = [\"energy\", \"P\"]\n"), HasSubstr("columns of one unit"));
  EXPECT_THAT(error_of(plot + "y = \"terms\"\n"), HasSubstr("one scene, with y = \"terms\""));
  EXPECT_THAT(error_of(plot + "y = \"P\"\nlabel = \"P / Pa\"\n"), HasSubstr("without its unit"));
  EXPECT_THAT(error_of(plot + "y = \"P\"\nx = \"v\"\nexact = true\n"), HasSubstr("x is t"));
  EXPECT_THAT(error_of(plot + "y = [\"energy\", \"line_energy\", \"bending_energy\", "
                              "\"bending_Ld\", \"bending_Lo\"]\n"),
              HasSubstr("at most 8 curves"));
  EXPECT_THAT(error_of("not TOML"), HasSubstr("mine.toml:1: this is not TOML"));
}

TEST(FigureFile, HoldsAllThatThePaperShows) {
  std::vector<std::string> names;
  for (const BuiltinFigure& figure : builtin_figures()) names.emplace_back(figure.name);
  std::vector<std::string> expected{"baumgart", "table1", "table2", "table3"};
  for (int n = 3; n <= 15; ++n) expected.push_back("fig" + std::to_string(n));
  EXPECT_THAT(names, testing::UnorderedElementsAreArray(expected));
}

class BuiltinFigures : public testing::TestWithParam<BuiltinFigure> {};

TEST_P(BuiltinFigures, NeedScenesThatThereAreAndExpectAnOutcome) {
  const FigureSpec figure = parse_figure(GetParam().text, std::string(GetParam().name) + ".toml");
  for (const RunSpec& run : runs_of(figure))
    EXPECT_NO_THROW(builtin_scene(run.scene, run.set)) << run.scene;
  for (const PanelSpec& panel : figure.panels) {
    const auto* membrane = std::get_if<MembranePanel>(&panel.content);
    if (!membrane) continue;
    const Scene scene = builtin_scene(membrane->run.scene, membrane->run.set);
    EXPECT_THAT(membrane->expect, Contains(testing::Key("components")));
    EXPECT_THAT(membrane->expect, Contains(testing::Key("genus")));
    ASSERT_FALSE(membrane->times.empty());
    EXPECT_NEAR(membrane->times.back(), scene.end_time, 1e-9 * scene.end_time);
    for (const double time : membrane->times) { // is what will be written beside the picture
      const double frames = time / scene.end_time * (scene.output.frames - 1);
      EXPECT_NEAR(frames, std::round(frames), 0.25) << membrane->run.scene << " at " << time;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, BuiltinFigures,
                         testing::ValuesIn(builtin_figures().begin(), builtin_figures().end()),
                         [](const auto& info) { return std::string(info.param.name); });

// ------------------------------------------------------------------------------------- outcomes

template <class Phi>
render::State state_of(Phi&& phi) {
  render::State state{{Grid::cube(48, 1), 0, {}}};
  for (std::size_t n = 0; n < state.frame.grid.size(); ++n)
    state.frame.phi.push_back(phi(state.frame.grid.position(n)));
  return state;
}

render::State starfish(int arms, double height) {
  return state_of([=](const Vec3& p) {
    const double angle = std::atan2(p[1], p[0]), rho = std::hypot(p[0], p[1]);
    return std::hypot(rho / (1 + height * std::cos(arms * angle + 0.3)), 3 * p[2]) - 0.6;
  });
}

TEST(Outcome, CountsArms) {
  for (const int arms : {2, 3, 4, 5, 6}) EXPECT_EQ(outcome_of(starfish(arms, 0.15), "arms"), arms);
  EXPECT_EQ(outcome_of(starfish(3, 0), "arms"), 0);
}

TEST(Outcome, CountsBeads) {
  const auto chain = [](int beads) {
    return state_of([=](const Vec3& p) {
      const double half = 0.8, phase = (p[2] + half) / (2 * half) * beads * std::numbers::pi;
      const double neck = 0.12 + 0.1 * std::abs(std::sin(phase));
      return std::max(std::hypot(p[0], p[1]) - neck, std::abs(p[2]) - half);
    });
  };
  for (const int beads : {2, 3, 5}) EXPECT_EQ(outcome_of(chain(beads), "beads"), beads);
  EXPECT_EQ(outcome_of(starfish(3, 0), "beads"), 1);
}

TEST(Outcome, CountsBudsAndNotFlatDomains) {
  const auto capped = [](double angle) {
    render::State state =
        state_of([](const Vec3& p) { return std::hypot(p[0], p[1], p[2]) - 0.6; });
    for (std::size_t n = 0; n < state.frame.grid.size(); ++n) {
      const auto [x, y, z] = state.frame.grid.position(n);
      state.frame.fields["psi"].push_back(0.6 * (std::atan2(std::hypot(x, y), z) - angle));
    }
    return state;
  };
  EXPECT_EQ(outcome_of(capped(0.6), "buds"), 0);
  EXPECT_EQ(outcome_of(capped(2.2), "buds"), 1) << "more than half a sphere";
}

TEST(Outcome, IsComparedWithWhatIsExpected) {
  render::State state{};
  state.measures.components = 3;
  state.measures.energy = 49.2;
  EXPECT_THAT(surprises(state, {{"components", {3, 3}}, {"energy", {49, 50}}}), IsEmpty());
  EXPECT_THAT(
      surprises(state, {{"components", {4, 4}}, {"energy", {50, 60}}, {"domains_Ld", {1, 1}}}),
      ElementsAre("components is 3, expected 4", "domains_Ld is not known of this run, expected 1",
                  "energy is 49.2, expected 50 to 60"));
}

// -------------------------------------------------------------------------------------- studies

TEST(StudyOfGrids, FitsTheOrder) {
  EXPECT_NEAR(fitted_order({{0.1, 3e-3}, {0.05, 3e-3 / 4}, {0.025, 3e-3 / 16}}), 2, 1e-12);
  EXPECT_TRUE(std::isnan(fitted_order({{0.1, 1}})));
}

TEST(StudyOfGrids, KeepsItsDigitsWhateverTheUnitOfLength) {
  Study study;
  study.vary = "grid.nodes";
  study.values = {48};
  study.quantities = {"P", "int_KM2"};
  const FigureTable table = table_of(study, {{-1.062e-7, 98}, {{-1.06e-7, 98.5}}, {40}, {"48³"}});
  EXPECT_EQ(table.csv(), "grid,pressure P / (10⁻⁷ κ/L³),error / (10⁻⁷ κ/L³),∫ KM² dA,error\n"
                         "48³,-1.0600,+0.0020,98.5000,+0.5000\nexact,-1.0620,,98.0000,\n");
}

TEST(StudyOfGrids, BecomesATable) {
  Study study;
  study.vary = "grid.nodes";
  study.values = {48, 64};
  study.quantities = {"P"};
  study.paper = {{NAN}, {-101.9}};
  const FigureTable table =
      table_of(study, {{-106.2}, {{-106.0}, {-106.15}}, {0.04, 0.03}, {"48³", "64³"}});
  EXPECT_EQ(table.csv(), "grid,pressure P / (κ/L³),error / (κ/L³),paper's / (κ/L³)\n"
                         "48³,-106.0000,+0.2000,\n"
                         "64³,-106.1500,+0.0500,+4.300\nexact,-106.2000,,\n");
  const StudyResult unknown{{NAN}, {{-106.0}, {-106.15}}, {0.04, 0.03}, {"48³", "64³"}};
  EXPECT_EQ(table_of(study, unknown).csv(),
            "grid,pressure P / (κ/L³)\n48³,-106.0000\n64³,-106.1500\n");
  EXPECT_THAT(table.cells().at(1), ElementsAre("", "*κ*/*L*³", "*κ*/*L*³", "*κ*/*L*³"));
  EXPECT_THAT(table.markdown(), HasSubstr("| 64³ | −106.1500 | +0.0500 | +4.300 |"));
}

// ---------------------------------------------------------------------------------------- units

using render::StoredStates;

/// The same physics in several units of energy and length.
class Units : public Cli {
protected:
  /// The folder of a run in other units, of a few steps.
  std::string run(const std::string& scene, const UnitChange& change) const {
    const std::string name = fmt::format("run{}", names_in(work()).size());
    write(work() / (name + ".toml"), to_toml(in_units(parse_scene(scene, "test"), change)));
    const Result result = call({"run", name + ".toml", "--no-pictures", "-o", name});
    EXPECT_EQ(result.code, 0) << result.err;
    return (work() / name).string();
  }

  static RunFinder finder() {
    return [](const RunSpec& run) { return fs::path(run.scene); };
  }

  static constexpr const char* one_phase = R"(
[grid]
nodes = 32
[shape]
kind = "oblate"
semi_axis = 0.7
reduced_volume = 0.8
[membrane]
spontaneous_curvature = -2
[volume]
constraint = "free"
pressure = -50
[area_difference]
multiplier = 3
[stretch]
modulus = 100
[contact]
disjoining_pressure = 10
disjoining_range = 0.1
[run]
end_time = 5e-6
[output]
frames = 3
)";
  static constexpr const char* two_phases = R"(
[grid]
nodes = 40
half_width = 1.5
[shape]
kind = "sphere"
radius = 0.98
[domains]
kind = "cap"
[ld]
spontaneous_curvature = -1
[lo]
bending_modulus = 2
gaussian_modulus = -1
[line]
tension = 10
geodesic_modulus = 0.5
torsion_modulus = 0.5
normal_modulus = 0.5
[stretch]
modulus = 200
[volume]
constraint = "ramped"
targets = 0.95
rate = 100
[run]
end_time = 5e-6
[output]
frames = 3
)";
};

/// Numbers on pictures differ by the unit of length alone, which is the scene's.
void expect_same(const StoredStates& a, const StoredStates& b, double length) {
  ASSERT_EQ(a.history().size(), b.history().size());
  EXPECT_GT(a.history().size(), 5u);
  Measures begin = a.history().front();
  for (const Field& field : row_of(begin)) {
    const std::string column(field.column);
    if (column.ends_with("_rel")) continue; // rounding
    const Dimension unit = dimension_of(field.unit);
    const double factor = std::pow(length, -(unit.length + 4 * unit.time));
    double largest = 0;
    for (const Measures& m : a.history()) largest = std::max(largest, std::abs(a.value(m, column)));
    for (std::size_t n = 0; n < a.history().size(); ++n)
      EXPECT_NEAR(b.value(b.history()[n], column) * factor, a.value(a.history()[n], column),
                  1e-6 * largest)
          << column;
  }
}

TEST_F(Units, OfAllColumnsAreThoseThatTheSamePhysicsHas) {
  for (const char* scene : {one_phase, two_phases}) {
    const StoredStates a(run(scene, {})), b(run(scene, {.energy = 25}));
    expect_same(a, b, 1);
  }
  const StoredStates a(run(one_phase, {})), b(run(one_phase, {.length = 5, .energy = 25}));
  expect_same(a, b, 5);
}

TEST_F(Units, OfPlotsTablesTimesAndColoursAreThoseBesideThem) {
  const std::string one = run(two_phases, {}), other = run(two_phases, {.energy = 25});
  const auto plot = [&](const std::string& run, const std::vector<std::string>& y) {
    PlotPanel panel;
    panel.runs = {{run, {}}};
    panel.y = y;
    return plot_of(panel, finder());
  };
  for (const auto& y : {std::vector<std::string>{"terms"}, {"sigma_Ld", "sigma_Lo"}, {"P"}}) {
    const render::Plot a = plot(one, y), b = plot(other, y);
    EXPECT_THAT(a.x.title, HasSubstr("*κ*_{Ld}"));
    EXPECT_EQ(a.x.title, b.x.title);
    EXPECT_EQ(a.y.title, b.y.title);
    ASSERT_EQ(a.series.size(), b.series.size());
    for (std::size_t s = 0; s < a.series.size(); ++s)
      for (std::size_t n = 0; n < a.series[s].points.size(); ++n)
        for (const int i : {0, 1})
          EXPECT_NEAR(a.series[s].points[n][i], b.series[s].points[n][i],
                      1e-6 * std::abs(a.series[s].points[n][i]))
              << y[0];
  }
  const auto table = [&](const std::string& run) {
    Study study;
    study.run = {run, {}};
    study.vary = "grid.nodes";
    study.values = {40};
    study.quantities = {"energy", "P", "line_radius"};
    study.exact = {100, 50, 1};
    return table_of(study, evaluate(study, finder())).csv();
  };
  EXPECT_THAT(table(one), AllOf(HasSubstr("grid,energy E / κLd,"), HasSubstr("\n40³,")));
  EXPECT_EQ(table(one), table(other));
  const auto surface = [&](const std::string& run, render::Quantity quantity) {
    const StoredStates states(run);
    return extract_surface(states.at(states.frames().back().time), quantity);
  };
  for (const render::Quantity quantity :
       {render::Quantity::velocity, render::Quantity::energy_density, render::Quantity::c}) {
    const render::Surface a = surface(one, quantity), b = surface(other, quantity);
    EXPECT_EQ(time_label(a.time, a.units), time_label(b.time, b.units));
    EXPECT_NEAR(range_of(quantity, {a}).high, range_of(quantity, {b}).high,
                1e-6 * range_of(quantity, {a}).high);
  }
}

// ---------------------------------------------------------------------------------- the command

constexpr const char* small_figure = R"(title = "Mine"
[[panel]]
scene = "fig3_oblate"
set = ["grid.nodes=32", "run.end_time=2e-5", "output.frames=3"]
times = [0, 2e-5]
expect = { components = 1, genus = GENUS }
[[panel]]
kind = "plot"
scenes = "fig3_oblate"
set = ["grid.nodes=32", "run.end_time=2e-5", "output.frames=3"]
y = "energy"
)";

std::string figure_expecting_genus(const std::string& genus) {
  std::string text = small_figure;
  return text.replace(text.find("GENUS"), 5, genus);
}

TEST_F(Cli, draws_a_figure_and_takes_its_runs_from_the_store_the_next_time) {
  write(work() / "mine.toml", figure_expecting_genus("0"));
  const Result first = call(words("figure mine.toml -o out"));
  EXPECT_EQ(first.code, 0) << first.err;
  EXPECT_THAT(first.out, HasSubstr("1 of 1: fig3_oblate ran in"));
  EXPECT_EQ(names_in(work() / "out"),
            (std::set<std::string>{"mine.pdf", "mine.png", "mine.svg", "runs"}));
  EXPECT_EQ(names_in(work() / "out" / "runs").size(), 1u) << "one run for both panels";
  const Result second = call(words("figure mine.toml -o out --format png"));
  EXPECT_EQ(second.code, 0) << second.err;
  EXPECT_EQ(second.out, "mine: mine.png\n");
}

TEST_F(Cli, tells_an_outcome_that_is_not_as_expected) {
  write(work() / "mine.toml", figure_expecting_genus("1"));
  const Result result = call(words("figure mine.toml -o out --format svg"));
  EXPECT_EQ(result.code, 1);
  EXPECT_EQ(result.err,
            "lamella: mine: panel a, fig3_oblate at t = 2e-05: genus is 0, expected 1\n");
  EXPECT_TRUE(fs::exists(work() / "out" / "mine.svg"));
}

TEST_F(Cli, tells_why_a_figure_cannot_be_drawn) {
  write(work() / "mine.toml", figure_expecting_genus("0"));
  const Result refused = call(words("figure mine.toml -o out --set grid.nodes=33.5"));
  EXPECT_EQ(refused.code, 2);
  EXPECT_FALSE(fs::exists(work() / "out"));
  const Result unknown = call(words("figure fig33"));
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("neither a file nor a built-in figure"));
  const Result late = call(words("figure mine.toml -o out --set run.end_time=1e-6"));
  EXPECT_EQ(late.code, 2);
  EXPECT_THAT(late.err, HasSubstr("ends at t = 1e-06, before the time 2e-05"));
}

TEST_F(Cli, keeps_ended_runs_when_a_figure_is_interrupted) {
  write(work() / "mine.toml", "[[panel]]\nscene = \"fig9\"\n");
  const Program program(words("figure mine.toml -o out"), setting_);
  for (int n = 0; n < 400 && !fs::exists(work() / "out" / "runs"); ++n) usleep(50'000);
  usleep(300'000);
  program.interrupt();
  const Result result = program.wait();
  EXPECT_EQ(result.code, 130);
  EXPECT_THAT(result.err, HasSubstr("interrupted"));
  EXPECT_FALSE(fs::exists(work() / "out" / "mine.png"));
}

// ---------------------------------------------------------------------------------- lamella movie

TEST_F(Cli, makes_a_movie_or_pictures) {
  ASSERT_EQ(call(quick({"-o", "run"})).code, 0);
  const Arguments small = words("--seconds 0.4 --rate 10 --width 240 --height 200 --turntable");
  const Result pictures = call(words("movie run -o pictures", small));
  EXPECT_EQ(pictures.code, 0) << pictures.err;
  EXPECT_EQ(pictures.out, "pictures\n");
  EXPECT_EQ(names_in(work() / "pictures").size(), 4u);
  const Result movie = call(words("movie run", small));
  EXPECT_EQ(movie.code, 0) << movie.err;
  if (movie.err.empty())
    EXPECT_THAT(text_of(work() / "run" / "movie.mp4").substr(4, 4), "ftyp");
  else
    EXPECT_EQ(names_in(work() / "run" / "movie").size(), 4u) << "without ffmpeg";
  for (const std::string& name : names_in(work() / "run")) EXPECT_FALSE(name.starts_with("."));
  EXPECT_EQ(call(words("movie run --width 241")).code, 2);
  EXPECT_EQ(call(words("movie nothing")).code, 2);
}

/// Movies with an ffmpeg that knows the encoders given, and writes its arguments into its file.
class Movies : public Cli {
protected:
  Movies() : path_(std::getenv("PATH")) {}
  ~Movies() override { setenv("PATH", path_.c_str(), 1); }

  void SetUp() override {
    Cli::SetUp();
    ASSERT_EQ(call(quick({"-o", "run"})).code, 0);
  }

  void use_ffmpeg(const std::string& encoders) {
    fs::create_directory(base_ / "bin");
    write(base_ / "bin" / "ffmpeg", "#!/bin/sh\ncase \"$*\" in\n*-encoders*) echo ' V....D " +
                                        encoders +
                                        " '; exit ;;\nesac\ncat > /dev/null\nfor last; do :; done\n"
                                        "echo \"$@\" > \"${last#file:}\"\n");
    fs::permissions(base_ / "bin" / "ffmpeg", fs::perms::all);
    setenv("PATH", ((base_ / "bin").string() + ":" + path_).c_str(), 1);
  }

  Result movie(const std::string& output) {
    return call(words("movie run --seconds 0.2 --rate 10 --width 240 --height 200",
                      {"--output=" + output}));
  }

private:
  std::string path_;
};

TEST_F(Movies, TakeTheEncoderThatThereIs) {
  const std::vector<std::array<std::string, 3>> cases{
      {"libx264", "x.mp4", "-c:v libx264"},   {"libx264", "X.MP4", "-c:v libx264"},
      {"libx264", "a:b.mp4", "-c:v libx264"}, {"libx264", "-x.mp4", "-c:v libx264"},
      {"mpeg4", "plain.mp4", "-c:v mpeg4"},   {"mpeg4", "x.avi", "-c:v mpeg4"},
      {"libvpx", "x.webm", "-c:v libvpx "},   {"gif", "x.gif", "paletteuse"},
  };
  for (const auto& [encoder, output, expected] : cases) {
    use_ffmpeg(encoder);
    const Result result = movie(output);
    EXPECT_EQ(result.code, 0) << output << ": " << result.err;
    EXPECT_EQ(result.out, output + "\n");
    EXPECT_THAT(text_of(work() / output), HasSubstr(expected));
    fs::remove(work() / output);
    EXPECT_EQ(names_in(work()), std::set<std::string>{"run"}) << "nothing half-made";
  }
}

TEST_F(Movies, HaveAnyNameAndLeaveOthersAlone) {
  use_ffmpeg("libx264");
  write(work() / "x.mp4.part", "mine");
  EXPECT_EQ(movie("x.mp4").code, 0);
  EXPECT_EQ(text_of(work() / "x.mp4.part"), "mine");
  for (const std::string name : {"caf\xe9.mp4", "\xc3\xa9t\xc3\xa9.mp4"}) { // Latin-1, UTF-8
    const Result result = movie(name);
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_THAT(text_of(work() / name), HasSubstr("-c:v libx264"));
  }
}

TEST_F(Movies, SayWhatCannotBeWritten) {
  use_ffmpeg("gif");
  EXPECT_THAT(movie("x.webm").err, HasSubstr("(libvpx-vp9 or libvpx); choose another ending"));
  const Result other = movie("x.mov");
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.err, HasSubstr(".mp4, .webm, .avi or .gif"));
  EXPECT_EQ(names_in(work()), std::set<std::string>{"run"});
  setenv("PATH", "/nowhere", 1);
  const Result without = movie("x.gif");
  EXPECT_EQ(without.code, 0);
  EXPECT_THAT(without.err, HasSubstr("ffmpeg is not installed"));
  EXPECT_EQ(names_in(work() / "x").size(), 2u);
}

TEST_F(Cli, lists_the_figures) {
  const Result result = call({"figure"});
  EXPECT_EQ(result.code, 0);
  EXPECT_THAT(result.out, AllOf(HasSubstr("fig15 "), HasSubstr("table3 ")));
}

} // namespace
} // namespace lamella
