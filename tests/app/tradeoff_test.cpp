// Speed against accuracy: presets, references, the Pareto front, and the command as a whole.
#include "cli.h"

#include "error.h"
#include "scene/builtin.h"
#include "scene/preset.h"
#include "store/history.h"
#include "tradeoff/report.h"
#include "tradeoff/sweep.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace lamella {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::MatchesRegex;
using testing::StartsWith;

template <class Action>
std::string error_of(Action&& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

Trial timed(double seconds, double error) {
  Trial trial;
  trial.seconds = seconds;
  trial.errors.P = error;
  return trial;
}

Measures state(double time, double energy) {
  Measures m;
  m.time = time;
  m.energy = energy;
  return m;
}

// -------------------------------------------------------------------------------------- presets

TEST(Presets, scale_grid_and_tolerance) {
  const Scene scene;
  const Scene draft = at_preset(find_preset("draft"), scene);
  const Scene fine = at_preset(find_preset("fine"), scene);
  EXPECT_THAT(draft.nodes, ElementsAre(48, 48, 48));
  EXPECT_THAT(fine.nodes, ElementsAre(96, 96, 96));
  EXPECT_DOUBLE_EQ(draft.numerics.tolerance, 4 * scene.numerics.tolerance);
  EXPECT_DOUBLE_EQ(fine.numerics.tolerance, scene.numerics.tolerance / 4);
  EXPECT_EQ(at_preset(find_preset("standard"), scene), scene);
}

TEST(Presets, keep_the_box_in_proportion) {
  Scene scene;
  scene.nodes = {64, 64, 96};
  EXPECT_THAT(at_preset(find_preset("draft"), scene).nodes, ElementsAre(48, 48, 72));
  EXPECT_THAT(at_preset(find_preset("fine"), scene).nodes, ElementsAre(96, 96, 144));
  scene.nodes = {40, 48, 72};
  EXPECT_THAT(at_preset(find_preset("draft"), scene).nodes, ElementsAre(32, 40, 56))
      << "multiples of 8";
}

TEST(Presets, know_what_was_meant) {
  EXPECT_THAT(error_of([] { find_preset("fien"); }),
              AllOf(HasSubstr("draft, standard, fine"), HasSubstr("did you mean \"fine\"?")));
}

// ------------------------------------------------------------------------------------ references

TEST(References, are_read_between_their_rows) {
  const Reference reference("t,Delta_a,intKM2,P\n0,1,9,-50\n1e-4,1,4,-30\n1e-2,1,2,-10\n", "table");
  EXPECT_FALSE(reference.at_rest());
  EXPECT_DOUBLE_EQ(reference.at(1e-2).int_KM2, 2);
  EXPECT_DOUBLE_EQ(reference.at(1e-3).int_KM2, 3) << "half-way in the logarithm of time";
  EXPECT_DOUBLE_EQ(reference.at(1e-3).P, -20);
  EXPECT_DOUBLE_EQ(reference.at(5e-5).P, -40) << "there is no logarithm of 0";
  EXPECT_TRUE(std::isnan(reference.at(1e-3).energy)) << "not in the table";
  EXPECT_TRUE(reference.covers(1e-2));
  EXPECT_FALSE(reference.covers(1.1e-2));
}

TEST(References, may_be_one_state_at_rest) {
  const Reference reference("E\n25\n", "table");
  EXPECT_TRUE(reference.at_rest());
  EXPECT_TRUE(reference.covers(1e9));
  const std::vector<Measures> history{state(0, 40), state(1, 30), state(2, 26)};
  const Errors errors = compare(history, reference);
  EXPECT_NEAR(errors.energy, 1. / 25, 1e-15);
  EXPECT_TRUE(std::isnan(errors.course)) << "nothing is known of the way there";
  EXPECT_TRUE(std::isnan(errors.P));
  EXPECT_EQ(errors.largest(), errors.energy) << "of what is known";
}

TEST(References, count_all_of_the_last_two_decades) {
  std::string table = "t,E\n";
  std::vector<Measures> history{state(0, 7)};
  for (const double t : {1e-4, 1e-3, 1e-2, 1e-1}) {
    table += fmt::format("{},10\n", t);
    history.push_back(state(t, t < 1e-3 ? 100 : t < 1e-1 ? 11 : 10)); // 10 % too much, then right
  }
  const Errors errors = compare(history, Reference(table, "table"));
  EXPECT_NEAR(errors.course, (0.1 + 0.05) / 2, 1e-12);
  EXPECT_EQ(errors.energy, 0);
}

TEST(References, say_what_is_wrong_with_a_table) {
  const auto message = [](const char* table) {
    return error_of([&] { Reference(table, "my.csv"); });
  };
  EXPECT_THAT(message("t,P\n0,1\n"), AllOf(HasSubstr("my.csv"), HasSubstr("energy or int_KM2")));
  EXPECT_THAT(message("t,E\n0,1\n1,x\n"), HasSubstr("my.csv:3: column 2"));
  EXPECT_THAT(message("t,E\n0,1\n1\n"), HasSubstr("my.csv:3: column 2"));
  EXPECT_THAT(message("t,E\n1,1\n1,2\n"), HasSubstr("my.csv:3: times must ascend"));
  EXPECT_THAT(message("t,E\n"), HasSubstr("no rows"));
}

TEST(References, come_with_scenes_whose_physics_is_unchanged) {
  const auto known = [](const std::vector<std::string>& set) {
    return builtin_reference(builtin_scene("fig3_oblate", set)).has_value();
  };
  EXPECT_TRUE(known({}));
  EXPECT_TRUE(known({"grid.nodes=32", "numerics.tolerance=0.02", "run.end_time=1e-4"}));
  EXPECT_FALSE(known({"run.end_time=1e-2"})) << "the table ends before";
  EXPECT_FALSE(known({"membrane.spontaneous_curvature=-1"}));
  EXPECT_FALSE(builtin_reference(builtin_scene("sphere")).has_value());

  const auto rests = [](const char* end_time) {
    return builtin_reference(
               builtin_scene("fig8b", std::vector{fmt::format("run.end_time={}", end_time)}))
        .has_value();
  };
  EXPECT_TRUE(rests("6e-2"));
  EXPECT_FALSE(rests("1e-3")) << "not yet at rest";
}

TEST(References, hold_the_exact_oblate_vesicle) {
  const auto exact = builtin_reference(builtin_scene("fig3_oblate"))->at(1.6e-3);
  EXPECT_NEAR(exact.int_KM2, 98.3035, 1e-4);
  EXPECT_NEAR(exact.P, -106.147, 1e-3);
  EXPECT_NEAR(exact.sigma, -16.806, 1e-3);
}

// ---------------------------------------------------------------------------------------- sweeps

TEST(Sweep, contains_the_presets_and_goes_from_cheap_to_dear) {
  const Scene scene;
  const std::vector<Scene> scenes = sweep(scene, {});
  ASSERT_EQ(scenes.size(), 12u);
  std::vector<std::string_view> named;
  for (const Scene& variant : scenes)
    if (const auto name = preset_of(variant, scene); !name.empty()) named.push_back(name);
  EXPECT_THAT(named, ElementsAre("draft", "standard", "fine"));
  EXPECT_TRUE(std::ranges::is_sorted(scenes, {}, expected_cost));
  EXPECT_LT(expected_cost(scenes.back()), expected_cost(finer_than_all(scenes)));
}

TEST(Sweep, takes_what_is_given) {
  Scene scene;
  scene.nodes = {64, 128, 64};
  const std::vector<Scene> scenes = sweep(scene, {{32, 48}, {0.01}});
  ASSERT_EQ(scenes.size(), 2u);
  EXPECT_THAT(scenes[0].nodes, ElementsAre(32, 64, 32));
  EXPECT_THAT(scenes[1].nodes, ElementsAre(48, 96, 48));
  EXPECT_EQ(scenes[1].numerics.tolerance, 0.01);
  EXPECT_EQ(sweep(scene, {{}, {}, true}).size(), 3u);
}

TEST(Sweep, finds_the_front) {
  std::vector<Trial> trials{timed(1, 0.1),  timed(2, 0.2), timed(3, 0.05), timed(4, 0.05),
                            timed(5, 0.06), timed(6, NAN), timed(7, 0.01)};
  mark_front(trials);
  std::vector<double> front;
  for (const Trial& trial : trials)
    if (trial.on_front) front.push_back(trial.seconds);
  EXPECT_THAT(front, ElementsAre(1, 3, 4, 7)) << "as accurate is not more accurate";
}

TEST(Sweep, goes_on_after_a_run_that_cannot) {
  Scene coarse = builtin_scene("fig3_oblate");
  coarse.nodes = {16, 16, 16};
  const Trial trial = run_trial(coarse, [](double) { return true; });
  EXPECT_THAT(trial.stopped, HasSubstr("2.4 grid spacings from the side"));
  EXPECT_THAT(table_row(trial), HasSubstr("stopped: "));
  EXPECT_THAT(tradeoff_csv(std::vector{trial}), HasSubstr(",,,,,,,,,0,\"[shape] semi_axis: "));
}

TEST(Sweep, ends_runs_where_the_scene_says) {
  const Scene scene = builtin_scene(
      "fig3_oblate", std::vector<std::string>{"grid.nodes=32", "stop.residual_force=5e3"});
  const Trial trial = run_trial(scene, [](double) { return true; });
  EXPECT_EQ(trial.stopped, "");
  EXPECT_LT(trial.history.back().time, scene.end_time / 10);
}

// --------------------------------------------------------------------------------------- command

Arguments small_sweep(const Arguments& more = {}) {
  return words(
      "tradeoff -o out --set run.end_time=2e-5 --tolerances 0.02 --grids 32,40 fig3_oblate", more);
}

TEST_F(Cli, explains_itself) {
  const std::string help = call({"tradeoff", "--help"}).out;
  EXPECT_THAT(help, AllOf(HasSubstr("Examples:"), HasSubstr("--tolerances")));
}

TEST_F(Cli, weighs_time_against_accuracy) {
  const Result result = call(small_sweep());
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out,
              AllOf(StartsWith("fig3_oblate to t = 2e-05, compared with "
                               "relaxation_oblate_v0.6.csv\n"),
                    MatchesRegex("[ -~\n]+"), HasSubstr("\n32^3 "), HasSubstr("\n40^3 ")));
  EXPECT_THAT(names_in(work() / "out"), ElementsAre("tradeoff.csv", "tradeoff.md", "tradeoff.png"));
  EXPECT_THAT(text_of(work() / "out" / "tradeoff.png"), StartsWith("\x89PNG\r\n"));
  EXPECT_THAT(text_of(work() / "out" / "tradeoff.md"), HasSubstr("| **"));

  std::istringstream csv(text_of(work() / "out" / "tradeoff.csv"));
  std::vector<std::string> rows;
  for (std::string row; std::getline(csv, row);) rows.push_back(row);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_THAT(rows[0], StartsWith("nx,ny,nz,tolerance,preset,steps,seconds,energy,"));
  EXPECT_THAT(rows[1], StartsWith("32,32,32,0.02,,"));
  const auto column = [&](const std::string& row, int number) {
    std::istringstream cells(row);
    std::string cell;
    for (int n = 0; n <= number; ++n) std::getline(cells, cell, ',');
    return std::stod(cell);
  };
  for (const int row : {1, 2}) {
    EXPECT_GT(column(rows[row], 14), 0);
    EXPECT_LT(column(rows[row], 14), 0.1) << "measured: 0.03, 0.01";
  }
}

TEST_F(Cli, compares_with_a_run_where_nothing_exact_is_known) {
  const std::string scene = " fig3_oblate --set grid.nodes=32 --set run.end_time=2e-5 "
                            "--set membrane.spontaneous_curvature=-1 ";
  const std::string one = " --grids 32 --tolerances 0.005";
  const Result finer = call(words("tradeoff" + scene + one + " -o finer"));
  EXPECT_EQ(finer.code, 0) << finer.err;
  EXPECT_THAT(finer.out, StartsWith("Reference: a run at 40^3, tolerance 0.00125\n"));

  ASSERT_EQ(call(words("run" + scene + "-o run --no-pictures --set output.frames=2")).code, 0);
  const Result same =
      call(words("tradeoff" + scene + one + " -o same --reference run/history.csv"));
  EXPECT_EQ(same.code, 0) << same.err;
  EXPECT_THAT(same.out, MatchesRegex(".* [0-9.]+e-1[123]\n[^\n]+\n")) << "12 digits are stored";
}

TEST_F(Cli, replaces_a_sweep_only_when_told) {
  ASSERT_EQ(call(small_sweep()).code, 0);
  const Result result = call(small_sweep());
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, MatchesRegex("lamella: out: the folder holds a sweep[^\n]+--force\n"));
  EXPECT_EQ(call(small_sweep({"--force"})).code, 0);
}

TEST_F(Cli, follows_a_sweep_on_a_terminal) {
  if (!Program::has_terminals()) GTEST_SKIP() << "no pseudo-terminals here";
  const std::string all = Program::on_terminal(100, small_sweep(), setting_);
  EXPECT_THAT(all, HasSubstr("\rrun 1 of 2   32^3, tolerance 0.02   t = 0.0e+00 of 2.0e-05 "));
  EXPECT_THAT(all, ContainsRegex("\rrun 2 of 2   [0-9.]+ s left   40\\^3, "));
  EXPECT_THAT(all, ContainsRegex("\r +\r40\\^3 ")) << "the line is gone before the table goes on";
}

TEST_F(Cli, names_the_reference_that_is_no_use) {
  write(work() / "short.csv", "t,energy\n0,60\n1e-6,59\n");
  write(work() / "other.csv", "time,temperature\n0,60\n");
  const std::vector<std::tuple<std::string, int, const char*>> useless{
      {"away.csv", 4, "away.csv: cannot be read"},
      {"short.csv", 2, "short.csv: ends before the run, whose end_time is 2e-05"},
      {"other.csv", 2, "other.csv: no reference"},
  };
  for (const auto& [file, code, message] : useless) {
    const Result result = call(small_sweep({"--reference", file}));
    EXPECT_EQ(result.code, code);
    EXPECT_THAT(result.err, AllOf(MatchesRegex("lamella: [^\n]+\n"), HasSubstr(message)));
    EXPECT_FALSE(fs::exists(work() / "out"));
  }
}

TEST_F(Cli, runs_a_preset) {
  ASSERT_EQ(call(words("run --preset draft --no-pictures -o run --set run.end_time=1e-6 "
                       "fig3_oblate"))
                .code,
            0);
  EXPECT_THAT(text_of(work() / "run" / "scene.toml"),
              AllOf(HasSubstr("nodes = 48"), HasSubstr("tolerance = 0.02")));
}

class RefusedTradeoff : public Cli,
                        public testing::WithParamInterface<std::pair<const char*, const char*>> {};

TEST_P(RefusedTradeoff, with_one_clear_line_and_nothing_written) {
  const auto& [arguments, part] = GetParam();
  const Result result = call(words(arguments));
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, AllOf(MatchesRegex("lamella: [^\n]+\n"), HasSubstr(part)));
  EXPECT_THAT(names_in(work()), testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(
    Calls, RefusedTradeoff,
    testing::Values(
        std::pair{"tradeoff", "scene is required"},
        std::pair{"tradeoff fig3_oblat", "did you mean \"fig3_oblate\"?"},
        std::pair{"tradeoff sphere --grids 32,33", "33; allowed: an integer multiple of 8"},
        std::pair{"tradeoff sphere --grids many", "--grids"},
        std::pair{"tradeoff sphere --tolerances 0.005,0", "0; allowed: a number above 0"},
        std::pair{"tradeoff sphere --repeats 0", "--repeats"},
        std::pair{"tradeoff sphere --presets --grids 32", "excludes --presets"},
        std::pair{"tradeoff sphere --grid 32", "did you mean \"--grids\"?"},
        std::pair{"run sphere --preset fien", "did you mean \"fine\"?"},
        std::pair{"run sphere --preset fine --set grid.nodes=512", "out of range"}));

} // namespace
} // namespace lamella
