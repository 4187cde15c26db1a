// The contract of the program: commands, exit codes, and what is in the output folder.
#include "cli.h"

#include "error.h"
#include "store/frame.h"
#include "store/history.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>

namespace lamella {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::MatchesRegex;
using testing::Not;
using testing::StartsWith;

/// A run that breaks through in the middle.
Arguments rupturing(const Arguments& more = {}) {
  return words("run fig7b --no-pictures --set grid.nodes=48 --set run.end_time=1.3e-4", more);
}

/// A run that may not break through where it has to.
Arguments doomed() { return rupturing({"-o", "run", "--set", "contact.topology_changes=false"}); }

void expect_last_frame_at(double time, const fs::path& run) {
  const std::vector<fs::path> frames = frames_of(run);
  ASSERT_GE(frames.size(), 2u);
  EXPECT_NEAR(read_frame(frames.back()).time, time, 1e-11 * time);
  EXPECT_LT(read_frame(frames[frames.size() - 2]).time, time) << "no state is stored twice";
}

// ------------------------------------------------------------------------------------- commands

TEST_F(Cli, helps) {
  for (const Arguments& arguments : {Arguments{}, {"--help"}, {"-h"}}) {
    const Result result = call(arguments);
    EXPECT_EQ(result.code, 0);
    EXPECT_THAT(result.out, AllOf(HasSubstr("Subcommands:"), HasSubstr("lamella run fig3_oblate")));
    EXPECT_EQ(result.err, "");
  }
  std::istringstream lines(call({"--help"}).out);
  std::string line;
  while (std::getline(lines, line) && line != "Subcommands:") {
  }
  int commands = 0;
  for (; std::getline(lines, line) && line.starts_with("  "); ++commands) {
    const std::string command = line.substr(2, line.find(' ', 2) - 2);
    EXPECT_THAT(call({command, "--help"}).out,
                AllOf(HasSubstr("Examples:"), HasSubstr(fmt::format("\n  lamella {} ", command))));
  }
  EXPECT_GE(commands, 9);
}

TEST_F(Cli, tells_its_version) {
  const Result result = call({"--version"});
  EXPECT_EQ(result.code, 0);
  EXPECT_THAT(result.out, MatchesRegex("lamella [0-9]+\\.[0-9]+\\.[0-9]+[+][0-9a-f]{8} .*\n"));
}

TEST_F(Cli, lists_the_scenes) {
  const Result result = call({"scenes"});
  EXPECT_EQ(result.code, 0);
  for (const char* name : {"fig3_oblate", "fig3_prolate", "sphere", "torus"})
    EXPECT_THAT(result.out, HasSubstr(fmt::format("{} ", name)));
}

TEST_F(Cli, shows_a_scene_that_runs) {
  write(work() / "mine.toml", call({"scenes", "sphere"}).out);
  EXPECT_EQ(call({"run", "mine.toml", "--no-pictures", "--set", "run.end_time=1e-5"}).code, 0);
  EXPECT_TRUE(fs::exists(work() / "mine" / "history.csv")) << "the folder has the scene's name";
}

TEST_F(Cli, says_that_standard_output_is_full) {
  setting_.standard_output = "/dev/full";
  ASSERT_EQ(call(quick({"-o", "run"})).code, 4);
  for (const char* arguments :
       {"", "--help", "--version", "run --help", "scenes", "scenes sphere", "figure", "inspect run",
        "inspect run/frames/frame_0001.hdf", "export run --times 0"}) {
    const Result result = call(words(arguments));
    EXPECT_EQ(result.code, 4) << arguments;
    EXPECT_EQ(result.err, "lamella: standard output: No space left on device\n") << arguments;
  }
  EXPECT_TRUE(fs::exists(work() / "run" / "summary.txt")) << "it does not end a run";
}

// ------------------------------------------------------------------------------------ good runs

TEST_F(Cli, fills_the_folder) {
  const Result result = call(quick({"-o", "run"}));
  ASSERT_EQ(result.code, 0) << result.err;
  const fs::path run = work() / "run";
  EXPECT_THAT(names_in(run),
              ElementsAre("checkpoints", "components.csv", "events.csv", "frames", "history.csv",
                          "scene.toml", "status.toml", "summary.txt"));
  EXPECT_THAT(text_of(run / "history.csv"),
              StartsWith("t,dt,energy,bending_energy,int_KM2,P,sigma,K_multiplier,A,V,v,Da,dA_rel,"
                         "dV_rel,max_speed,components,genus"));

  const std::vector<Measures> history = check_stored(run);
  EXPECT_THAT(text_of(run / "summary.txt"),
              AllOf(HasSubstr(fmt::format("\n{} steps in ", history.size() - 1)),
                    HasSubstr("The run reached the end, t = 2e-05")));
  EXPECT_EQ(history.front().time, 0);
  EXPECT_DOUBLE_EQ(history.back().time, 2e-5);
  for (std::size_t i = 1; i < history.size(); ++i)
    EXPECT_NEAR(history[i].time - history[i - 1].time, history[i].dt, 1e-15);

  const std::vector<fs::path> frames = frames_of(run);
  ASSERT_EQ(frames.size(), 5u);
  const std::string series = text_of(run / "frames" / "frames.hdf.series");
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(read_frame(frames[i]).time, 5e-6 * double(i), 1e-17);
    EXPECT_THAT(series, HasSubstr(fmt::format("\"{}\"", frames[i].filename().string())));
  }
}

TEST_F(Cli, says_little_where_nobody_looks) {
  const Result result = call(quick());
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, MatchesRegex("[ -~]+\n[ -~]+\n[ -~]+\n")) << "three lines of plain text";
}

TEST_F(Cli, says_nothing_into_its_files_where_it_has_no_output) {
  setting_.closed_output = true;
  EXPECT_EQ(call(quick({"-o", "run"})).code, 0);
  check_stored(work() / "run");
  EXPECT_THAT(text_of(work() / "run" / "history.csv"), StartsWith("t,dt,"));
}

TEST_F(Cli, tells_the_largest_drift_of_the_run) {
  ASSERT_EQ(call(quick({"-o", "run"})).code, 0);
  double area = 0, volume = 0;
  for (const Measures& row : read_history(work() / "run" / "history.csv")) {
    area = std::max(area, std::abs(row.area_drift));
    volume = std::max(volume, std::abs(row.volume_drift));
  }
  EXPECT_THAT(text_of(work() / "run" / "summary.txt"),
              HasSubstr(fmt::format("area {:.1e}, volume {:.1e}", area, volume)));
}

TEST_F(Cli, repeats_a_run_to_the_last_bit) {
  ASSERT_EQ(call(quick({"-o", "first", "--threads", "1"})).code, 0);
  ASSERT_EQ(
      call({"run", "first/scene.toml", "-o", "again", "--no-pictures", "--threads", "2"}).code, 0);
  for (const char* file : {"history.csv", "scene.toml", "frames/frame_0004.hdf"})
    EXPECT_EQ(text_of(work() / "first" / file), text_of(work() / "again" / file)) << file;
}

TEST_F(Cli, takes_any_folder_name) {
  for (const char* name : {"my run", "Bl\u00e4schen/\u03c3", "./a/../b/", "--set"}) {
    const Result result = call(quick({fmt::format("--output={}", name)}));
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_TRUE(fs::exists(work() / name / "summary.txt")) << name;
  }
}

TEST_F(Cli, knows_files_and_built_in_scenes_apart) {
  write(work() / "sphere", "title = \"mine\"\n[shape]\nkind = \"sphere\"\n");
  const auto scene_run_as = [&](const std::string& name, const std::string& folder) {
    const std::string brief = "--no-pictures --set run.end_time=1e-7 --set grid.nodes=32";
    EXPECT_EQ(call(words("run " + name + " -o " + folder + " " + brief)).code, 0);
    return text_of(work() / folder / "scene.toml");
  };
  EXPECT_THAT(scene_run_as("./sphere", "file"), HasSubstr("title = \"mine\""));
  EXPECT_THAT(scene_run_as("sphere", "built-in"), HasSubstr("title = \"Sphere at rest\""));

  fs::create_directory(work() / "torus");
  write(work() / "torus" / "note.txt", "");
  EXPECT_THAT(scene_run_as("torus", "other"), HasSubstr("kind = \"torus\""));
  const Result result = call({"run", "torus"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("torus: the folder is not empty"));
}

// ------------------------------------------------------------------------------- early endings

/// Ends well before its end time, with what there is as its last frame.
void expect_ended(const Result& result, const fs::path& run, const std::string& words) {
  EXPECT_EQ(result.code, 0) << result.err;
  const double end = check_stored(run).back().time;
  const std::string sentence = fmt::format("The run {} at t = {:.6g}\n", words, end);
  EXPECT_THAT(result.out, HasSubstr(sentence));
  EXPECT_THAT(text_of(run / "summary.txt"), HasSubstr(sentence));
  expect_last_frame_at(end, run);
}

TEST_F(Cli, ends_where_the_vesicle_has_settled) {
  const Result result =
      call(words("run sphere -o run --no-pictures --set grid.nodes=16 --set shape.radius=0.45 "
                 "--set run.end_time=10 --set stop.energy_rate=1e3"));
  expect_ended(result, work() / "run", "settled");
  EXPECT_EQ(read_history(work() / "run" / "history.csv").size(), 6u) << "the start and five steps";
}

TEST_F(Cli, ends_after_as_many_topology_changes_as_asked) {
  const Result result = call(rupturing({"-o", "run", "--set", "stop.topology_changes=1"}));
  expect_ended(result, work() / "run", "stopped as asked after 1 topology change");
  EXPECT_TRUE(read_events(work() / "run" / "events.csv").back().changes_topology());
}

TEST_F(Cli, ends_when_its_wall_clock_time_is_up) {
  const Result result =
      call(slow("10", {"-o", "run", "--no-pictures", "--set", "stop.wall_time=0.2"}));
  expect_ended(result, work() / "run", "used up its wall-clock budget of 0.2 s");
}

// --------------------------------------------------------------------------------------- events

TEST_F(Cli, tells_and_stores_events) {
  const Result result = call(rupturing({"-o", "run"}));
  const fs::path run = work() / "run";
  const std::vector<Event> events = read_events(run / "events.csv");
  const double spacing = 2. / 48;
  ASSERT_TRUE(std::ranges::any_of(events, &Event::changes_topology));
  std::string lines, section = "\nEvents\n";
  for (const Event& event : events) {
    lines += to_text(event, spacing) + '\n';
    section += "  " + to_text(event, spacing) + '\n';
  }
  EXPECT_THAT(result.out, HasSubstr("threads\n" + lines)) << "right after the line on the start";
  EXPECT_THAT(text_of(run / "summary.txt"), HasSubstr(section));
}

/// Two balls with a thin neck, from a stored frame: they part at once.
TEST_F(Cli, stores_what_each_of_several_vesicles_has) {
  const Grid grid = Grid::cube(32, 1);
  Frame frame{.grid = grid};
  for (std::size_t n = 0; n < grid.size(); ++n) {
    const auto [x, y, z] = grid.position(n);
    frame.phi.push_back(
        std::min(std::hypot(x - 0.4, y, z) - 0.3, std::hypot(x + 0.4, y, z) - 0.35));
  }
  write_frame(work() / "two.hdf", frame);
  write(work() / "two.toml", "[grid]\nnodes = 32\n[shape]\nkind = 'frame'\nfile = 'two.hdf'\n"
                             "[run]\nend_time = 1e-5\n");
  const Result result = call(words("run two.toml -o run --no-pictures"));
  ASSERT_EQ(result.code, 0) << result.err;
  const std::vector<Measures> history = read_history(work() / "run" / "history.csv");
  const std::vector<ComponentMeasures> vesicles =
      read_components(work() / "run" / "components.csv");
  ASSERT_EQ(vesicles.size(), 2 * history.size());
  for (std::size_t i = 0; i < history.size(); ++i) {
    const ComponentMeasures &a = vesicles[2 * i], &b = vesicles[2 * i + 1];
    EXPECT_EQ(a.time, history[i].time);
    EXPECT_EQ(a.component, 1);
    EXPECT_EQ(b.component, 2);
    EXPECT_NEAR(a.center[0], -0.4, 1e-3) << "the larger one";
    EXPECT_NEAR(a.volume + b.volume, history[i].volume, 1e-10);
    EXPECT_NEAR(a.area + b.area, history[i].area, 1e-10);
  }
  EXPECT_THAT(text_of(work() / "run" / "summary.txt"), HasSubstr("\n1           -0.3995 "));
  EXPECT_THAT(call(words("inspect run")).out, HasSubstr("\nvesicle 2 "));
}

TEST_F(Cli, warns_where_the_grid_was_too_coarse) {
  const Result result = call(words("run fig8d --no-pictures --set run.end_time=1e-6 -o run"));
  const std::vector<Event> events = read_events(work() / "run" / "events.csv");
  const auto first = std::ranges::find_if(events, &Event::is_under_resolved);
  ASSERT_NE(first, events.end());
  const std::string warning = fmt::format(
      "arning: the grid did not resolve the membrane everywhere, first at t = {:.6g}", first->time);
  EXPECT_THAT(result.err, ContainsRegex("^lamella: w" + warning + "[^\n]+grid.nodes[^\n]+\n"));
  EXPECT_THAT(text_of(work() / "run" / "summary.txt"), HasSubstr("\nW" + warning));
}

TEST_F(Cli, tells_events_above_its_progress) {
  if (!Program::has_terminals()) GTEST_SKIP() << "no pseudo-terminals here";
  const std::string all = Program::on_terminal(100, rupturing({"-o", "run"}), setting_);
  const std::vector<Event> events = read_events(work() / "run" / "events.csv");
  ASSERT_FALSE(events.empty());
  for (const Event& event : events) {
    const std::size_t at = all.find(to_text(event, 2. / 48) + "\r\n");
    ASSERT_NE(at, all.npos);
    EXPECT_THAT(all[at - 1], AnyOf('\r', '\n')) << "not behind the progress";
  }
}

// ----------------------------------------------------------------------- folders that are in use

TEST_F(Cli, refuses_a_folder_with_something_in_it) {
  const fs::path folder = work() / "full";
  fs::create_directory(folder);
  write(folder / "scene.toml", "# by hand");
  for (const Arguments& more : {Arguments{"-o", "full"}, {"-o", "full", "--force"}}) {
    const Result result = call(quick(more));
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.err, MatchesRegex("lamella: full: the folder [^\n]+\n"));
    EXPECT_THAT(names_in(folder), ElementsAre("scene.toml"));
    EXPECT_EQ(text_of(folder / "scene.toml"), "# by hand");
  }
}

TEST_F(Cli, replaces_a_run_only_when_told_and_keeps_what_is_not_its_own) {
  const fs::path run = work() / "run";
  ASSERT_EQ(call(quick({"-o", "run"})).code, 0);
  const std::string history = text_of(run / "history.csv");
  EXPECT_THAT(call(quick({"-o", "run"})).err, HasSubstr("--force"));
  EXPECT_EQ(text_of(run / "history.csv"), history);

  for (const char* own :
       {"figure.png", "start.hdf", ".summary.txt.12-0.tmp", "frames/.frame_0007.hdf.12-9.tmp"})
    write(run / own, "old");
  const std::vector<const char*> others{"notes.txt", "frames/mine.hdf", "history.csv.bak"};
  for (const char* other : others) write(run / other, "precious");
  ASSERT_EQ(call(quick({"-o", "run", "--force", "--set", "output.frames=2"})).code, 0);
  for (const char* other : others) EXPECT_EQ(text_of(run / other), "precious") << other;
  EXPECT_THAT(names_in(run / "frames"),
              ElementsAre("frame_0000.hdf", "frame_0001.hdf", "frames.hdf.series", "mine.hdf"));
  EXPECT_THAT(names_in(run), ElementsAre("checkpoints", "components.csv", "events.csv", "frames",
                                         "history.csv", "history.csv.bak", "notes.txt",
                                         "scene.toml", "status.toml", "summary.txt"));
}

TEST_F(Cli, keeps_the_old_run_when_the_new_one_cannot_start) {
  ASSERT_EQ(call(quick({"-o", "run"})).code, 0);
  const std::set<std::string> before = names_in(work() / "run");
  EXPECT_EQ(call(words("run sphere -o run --force --set shape.kind=frame --set shape.file=run "
                       "--set grid.nodes=48"))
                .code,
            2)
      << "its start is on another grid";
  EXPECT_EQ(names_in(work() / "run"), before);
}

// ------------------------------------------------------------------------ runs that do not end
// well

TEST_F(Cli, stores_and_draws_what_there_is_when_interrupted) {
  const Program program(slow("10", {"-o", "run"}), setting_);
  wait_for_rows(work() / "run");
  program.interrupt();
  const Result result = program.wait();
  EXPECT_EQ(result.code, 75);
  EXPECT_THAT(result.err, MatchesRegex("lamella: the run was interrupted at t = [^\n]+; `lamella "
                                       "run --resume run` goes on\n"));
  const std::vector<Measures> history = check_stored(work() / "run");
  EXPECT_GT(history.size(), 5u);
  expect_last_frame_at(history.back().time, work() / "run");
  EXPECT_THAT(text_of(work() / "run" / "summary.txt"), HasSubstr("was interrupted at t = "));
  EXPECT_THAT(names_in(work() / "run"), IsSupersetOf({"figure.png", "energy.png"}));
}

TEST_F(Cli, goes_on_where_interrupts_are_ignored) {
  setting_.ignored = {SIGINT};
  const Program program(slow("0.005", {"-o", "run", "--no-pictures"}), setting_);
  wait_for_rows(work() / "run");
  program.interrupt();
  EXPECT_EQ(program.wait().code, 0);
}

TEST_F(Cli, keeps_the_last_good_state_of_a_run_that_cannot_go_on) {
  const Result result = call(doomed());
  EXPECT_EQ(result.code, 3);
  EXPECT_THAT(result.err,
              ContainsRegex("^lamella: the run stopped at t = [0-9.e-]+: [a-z][^\n]+\n"));
  const std::vector<Measures> history = check_stored(work() / "run");
  expect_last_frame_at(history.back().time, work() / "run");
  EXPECT_THAT(text_of(work() / "run" / "summary.txt"),
              HasSubstr(fmt::format("The run stopped at t = {:.6g}: ", history.back().time)));
}

/// Sound up to where a file could not be written, and said so.
void expect_cut_short(const Result& result, const fs::path& run, const char* system_says) {
  EXPECT_EQ(result.code, 4);
  EXPECT_THAT(result.err, AllOf(MatchesRegex("lamella: [^\n]+\n"), HasSubstr(system_says),
                                HasSubstr("the run stopped at t = ")));
  EXPECT_GT(check_stored(run).size(), 100u);
  EXPECT_GE(frames_of(run).size(), 1u);
}

TEST_F(Cli, stops_when_a_file_may_not_grow) {
  setting_.largest_file = 60000;
  const Result result = call(slow("0.01", {"-o", "run"}));
  expect_cut_short(result, work() / "run", "run/history.csv: cannot be written: File too large");
}

TEST_F(Cli, stops_when_the_disk_is_full) {
  const fs::path disk = base_ / "small";
  fs::create_directory(disk);
  if (mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=128k") != 0)
    GTEST_SKIP() << "a small disk can only be made by root";
  const Result result = call(slow("0.02", {"-o", (disk / "run").string(), "--no-pictures"}));
  expect_cut_short(result, disk / "run", "No space left on device");
}

TEST_F(Cli, says_that_a_folder_cannot_be_used) {
  write(work() / "file", "");
  const std::vector<std::pair<std::string, const char*>> unusable{
      {"file", "exists and is not a folder"},
      {"file/run", "Not a directory"},
      {"/proc/run", "No such file or directory"},
  };
  for (const auto& [folder, why] : unusable) {
    const Result result = call(quick({"-o", folder}));
    EXPECT_EQ(result.code, 4) << folder;
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err,
                AllOf(MatchesRegex("lamella: [^\n]+\n"), HasSubstr(folder), HasSubstr(why)));
  }
  EXPECT_THAT(names_in(work()), ElementsAre("file"));
}

TEST_F(Cli, says_that_it_may_not_write) {
  setting_.without_privileges = true;
  fs::permissions(work(), fs::perms(0555));
  const Result result = call(quick({"-o", "run"}));
  if (result.code == 126 || result.code == 127)
    GTEST_SKIP() << "the program cannot be started without root's privileges here";
  EXPECT_EQ(result.code, 4);
  EXPECT_THAT(result.err, MatchesRegex("lamella: run: [^\n]*Permission denied\n"));
  EXPECT_TRUE(fs::is_empty(work()));
}

// ------------------------------------------------------------------------------------- pictures

TEST_F(Cli, draws_again) {
  ASSERT_EQ(call(quick({"-o", "run"})).code, 0);
  const Result result = call({"render", "run", "--width", "400"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out, "run/figure.png\nrun/energy.png\n");
  for (const char* picture : {"figure.png", "energy.png"})
    EXPECT_THAT(text_of(work() / "run" / picture), StartsWith("\x89PNG\r\n"));
}

TEST_F(Cli, keeps_the_numbers_where_nothing_can_be_drawn) {
  Arguments arguments = quick({"-o", "run", "--backend", "x"});
  std::erase(arguments, "--no-pictures");
  const Result result = call(arguments);
  EXPECT_EQ(result.code, 5);
  EXPECT_THAT(result.err, AllOf(MatchesRegex("lamella: no pictures: [^\n]+\n"),
                                HasSubstr("DISPLAY"), HasSubstr("lamella render")));
  EXPECT_THAT(names_in(work() / "run"),
              ElementsAre("checkpoints", "components.csv", "events.csv", "frames", "history.csv",
                          "scene.toml", "status.toml", "summary.txt"));
  EXPECT_EQ(call({"render", "run", "--backend", "x"}).code, 5);
}

TEST_F(Cli, names_the_damaged_file_of_a_run) {
  ASSERT_EQ(call(quick({"-o", "run"})).code, 0);
  const fs::path last = frames_of(work() / "run").back();
  fs::resize_file(last, fs::file_size(last) / 2);
  const Result result = call({"render", "run"});
  EXPECT_EQ(result.code, 4);
  EXPECT_THAT(result.err, MatchesRegex("lamella: run/frames/frame_0004.hdf: [^\n]+\n"));
}

// ------------------------------------------------------------------------------------- progress

/// The states of the terminal's line: what stands between carriage returns and newlines.
std::vector<std::string> lines_on_terminal(unsigned short columns, const Setting& setting) {
  const std::string all = Program::on_terminal(
      columns, slow("0.02", {"-o", fmt::format("run{}", columns), "--no-pictures"}), setting);
  std::vector<std::string> lines{""};
  for (const char c : all)
    if (c == '\r' || c == '\n')
      lines.emplace_back();
    else
      lines.back() += c;
  std::erase_if(lines, [](const std::string& line) {
    return !line.starts_with("t = ") || line.find(" of ") == line.npos;
  });
  return lines;
}

TEST_F(Cli, shows_its_progress_on_a_terminal) {
  if (!Program::has_terminals()) GTEST_SKIP() << "no pseudo-terminals here";
  const std::vector<std::string> lines = lines_on_terminal(100, setting_);
  ASSERT_GE(lines.size(), 2u);
  for (const std::string& line : lines)
    EXPECT_THAT(line, MatchesRegex("t = [0-9.e+-]+ of 2.000e-02   [0-9a-z .]+ left   E = [0-9.]+   "
                                   "dt = [0-9.e+-]+   step [0-9]+ *"));
  EXPECT_LT(std::stod(lines.front().substr(4)), std::stod(lines.back().substr(4)));
}

TEST_F(Cli, keeps_its_progress_within_a_narrow_terminal) {
  if (!Program::has_terminals()) GTEST_SKIP() << "no pseudo-terminals here";
  const std::vector<std::string> lines = lines_on_terminal(44, setting_);
  ASSERT_GE(lines.size(), 2u);
  for (const std::string& line : lines) {
    EXPECT_LE(line.size(), 43u);
    EXPECT_THAT(line, MatchesRegex("t = [0-9.e+-]+ of 2.000e-02   [0-9a-z .]+ left *"));
  }
}

} // namespace
} // namespace lamella
