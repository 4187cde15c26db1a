// Runs that start from a stored frame.
#include "cli.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <chrono>
#include <thread>

namespace lamella {
namespace {

using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;
using testing::StartsWith;

/// Starts where another run ended, on the grid of quick().
std::string scene_from(const std::string& file) {
  return fmt::format("[grid]\nnodes = 32\n[shape]\nkind = \"frame\"\nfile = \"{}\"\n"
                     "[run]\nend_time = 1e-6\n[output]\nframes = 2\n",
                     file);
}

class Continued : public Cli {
protected:
  void SetUp() override {
    Cli::SetUp();
    ASSERT_EQ(call(quick({"-o", "scenes/first"})).code, 0);
    write(work() / "scenes" / "second.toml", scene_from("first"));
  }
  /// The start of a run, after it has run.
  std::string start_of(const Arguments& arguments, const std::string& folder) {
    Arguments all{"run", "--no-pictures", "-o", folder};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Result result = call(all);
    EXPECT_EQ(result.code, 0) << result.err;
    check_stored(work() / folder);
    return text_of(work() / folder / "start.hdf");
  }
  std::string refusal_of(const std::string& file, int code = 2) {
    write(work() / "scenes" / "bad.toml", scene_from(file));
    const Result result = call({"run", "scenes/bad.toml", "-o", "bad"});
    EXPECT_EQ(result.code, code) << file;
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, MatchesRegex("lamella: [^\n]+\n"));
    EXPECT_FALSE(fs::exists(work() / "bad"));
    return result.err;
  }
  fs::path first_frame(int number) const {
    return work() / "scenes" / "first" / "frames" / fmt::format("frame_{:04}.hdf", number);
  }
};

TEST_F(Continued, where_a_run_ended) {
  EXPECT_EQ(start_of({"scenes/second.toml"}, "run"), text_of(first_frame(4)));
  const Measures end = read_history(work() / "scenes" / "first" / "history.csv").back(),
                 start = read_history(work() / "run" / "history.csv").front();
  EXPECT_EQ(start.time, 0);
  EXPECT_NEAR(start.energy, end.energy, 1e-3 * end.energy);
}

TEST_F(Continued, at_any_frame_with_paths_of_the_command_line_from_the_current_folder) {
  EXPECT_EQ(
      start_of({"scenes/second.toml", "--set", "shape.file=scenes/first/frames/frame_0002.hdf"},
               "run"),
      text_of(first_frame(2)));
}

TEST_F(Continued, again_from_its_own_folder_alone) {
  const std::string start = start_of({"scenes/second.toml"}, "run");
  const std::string history = text_of(work() / "run" / "history.csv");
  fs::remove_all(work() / "scenes");
  EXPECT_THAT(text_of(work() / "run" / "scene.toml"), HasSubstr("file = \"start.hdf\""));
  EXPECT_EQ(start_of({"run/scene.toml"}, "elsewhere"), start);
  EXPECT_EQ(text_of(work() / "elsewhere" / "history.csv"), history);
  EXPECT_EQ(start_of({"run/scene.toml", "--force"}, "run"), start) << "in the very same folder";
  EXPECT_EQ(text_of(work() / "run" / "history.csv"), history);
}

TEST_F(Continued, with_the_end_of_a_built_in_scene_that_runs_first) {
  setenv("TMPDIR", base_.c_str(), 1);
  write(work() / "third.toml", scene_from("sphere"));
  const Result result = call({"run", "third.toml", "--no-pictures"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, StartsWith("third starts where sphere ends, which runs first"));
  EXPECT_THAT(names_in(work()), ElementsAre("scenes", "third", "third.toml"));
  EXPECT_THAT(names_in(base_), Each(Not(HasSubstr(".hdf")))) << "nothing temporary is left";
  unsetenv("TMPDIR");

  ASSERT_EQ(call(words("run sphere --no-pictures --set grid.nodes=32")).code, 0);
  EXPECT_EQ(start_of({"third.toml"}, "from_folder"), text_of(work() / "third" / "start.hdf"));
  ASSERT_EQ(call(words("run sphere --no-pictures --force --set grid.nodes=32 "
                       "--set shape.radius=0.7"))
                .code,
            0);
  EXPECT_NE(start_of({"third.toml"}, "from_other"), text_of(work() / "third" / "start.hdf"))
      << "a folder of that name goes first";
  fs::remove(work() / "sphere" / "summary.txt");
  EXPECT_EQ(start_of({"third.toml"}, "from_none"), text_of(work() / "third" / "start.hdf"))
      << "if the run in it has ended";
}

TEST_F(Continued, not_when_interrupted_before) {
  write(work() / "third.toml", scene_from("fig3_oblate"));
  const Program program({"run", "third.toml", "--set", "grid.nodes=64"}, setting_);
  while (!text_of(base_ / "work.out").starts_with("third starts where fig3_oblate ends"))
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  program.interrupt();
  const Result result = program.wait();
  EXPECT_EQ(result.code, 130);
  EXPECT_EQ(result.err, "lamella: interrupted before the run began; nothing was written\n");
  EXPECT_FALSE(fs::exists(work() / "third"));
}

TEST_F(Continued, only_from_what_is_there) {
  EXPECT_THAT(refusal_of("frst"), HasSubstr("bad: [shape] file = \"frst\": no such frame, run or"));
  EXPECT_THAT(refusal_of("sphre"), HasSubstr("did you mean \"sphere\"?"));
  EXPECT_THAT(refusal_of("."),
              HasSubstr("is neither a frame nor the folder of a run that has ended"));
  fs::remove(work() / "scenes" / "first" / "summary.txt");
  EXPECT_THAT(refusal_of("first"), HasSubstr("is neither a frame nor the folder of a run"));
  EXPECT_THAT(refusal_of("second.toml", 4), HasSubstr("second.toml: cannot be read as a frame"));
}

TEST_F(Continued, only_with_phases_that_are_there) {
  const auto refusal = [&](const std::string& file) {
    write(work() / "scenes" / "bad.toml",
          scene_from("first") + "[domains]\nkind = \"frame\"\n" + file);
    const Result result = call({"run", "scenes/bad.toml", "-o", "bad"});
    EXPECT_EQ(result.code, 2);
    EXPECT_FALSE(fs::exists(work() / "bad"));
    return result.err;
  };
  EXPECT_THAT(refusal("file = \"frst\"\n"),
              HasSubstr("bad: [domains] file = \"frst\": no such frame or run"));
  EXPECT_THAT(refusal("file = \"first/frames/frame_0001.hdf\"\n"),
              HasSubstr("frame_0001.hdf has one phase; domains.kind must be \"none\""));
  EXPECT_THAT(refusal(""), HasSubstr("frame_0004.hdf has one phase"));
}

TEST_F(Continued, only_on_the_grid_of_the_frame) {
  const Result result = call({"run", "scenes/second.toml", "-o", "run", "--set", "grid.nodes=48"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("32 x 32 x 32"), HasSubstr("48 x 48 x 48"),
                                HasSubstr("grid.nodes and grid.half_width must be those of")));
  EXPECT_FALSE(fs::exists(work() / "run"));
}

} // namespace
} // namespace lamella
