#include "cli.h"

#include "store/checkpoint.h"
#include "store/run_status.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

// Runs that are interrupted, killed or starved of disk space, and go on.
namespace lamella {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

const char* const one_phase =
    "fig3_oblate --set grid.nodes=24 --set run.end_time=8e-4 --set output.frames=9";
const char* const two_phases = "fig9 --set grid.nodes=32 --set run.end_time=8e-5 "
                               "--set output.frames=4 --set stretch.modulus=500";

class Resume : public Cli {
protected:
  /// Without pictures.
  Result run(const std::string& arguments) const {
    return call(words("run --no-pictures " + arguments));
  }

  std::vector<fs::path> checkpoints_of(const fs::path& run) const {
    std::vector<fs::path> files;
    if (fs::exists(work() / run / "checkpoints"))
      for (const auto& entry : fs::directory_iterator(work() / run / "checkpoints"))
        if (entry.path().extension() == ".hdf") files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
  }

  /// Waits until a run has stored so many checkpoints.
  void wait_for_checkpoints(const fs::path& run, std::size_t count) const {
    ASSERT_TRUE(comes_true([&] { return checkpoints_of(run).size() >= count; }));
  }

  /// Stops a run after its first checkpoint, as a power failure does.
  void cut_short(const std::string& arguments, int signal = SIGKILL) const {
    const Program program(words("run --no-pictures " + arguments), setting_);
    wait_for_checkpoints("run", 1);
    program.signal(signal);
    program.wait();
  }

  /// That two runs left the same numbers, to the last bit.
  void expect_same_run(const fs::path& a, const fs::path& b) const {
    for (const char* file :
         {"scene.toml", "history.csv", "events.csv", "components.csv", "frames/frames.hdf.series"})
      EXPECT_EQ(text_of(work() / a / file), text_of(work() / b / file)) << file;
    const auto frames = frames_of(work() / a);
    EXPECT_EQ(frames.size(), frames_of(work() / b).size());
    for (const fs::path& frame : frames)
      EXPECT_TRUE(text_of(frame) == text_of(work() / b / "frames" / frame.filename())) << frame;
    ASSERT_FALSE(checkpoints_of(a).empty() || checkpoints_of(b).empty());
    const SimulationState end = read_checkpoint(checkpoints_of(a).back()).state,
                          other = read_checkpoint(checkpoints_of(b).back()).state;
    EXPECT_EQ(end.vesicle.phi, other.vesicle.phi);
    EXPECT_EQ(end.stepper.increment, other.stepper.increment);
    ASSERT_EQ(end.vesicle.fields.size(), other.vesicle.fields.size());
    for (const auto& [name, field] : end.vesicle.fields)
      EXPECT_EQ(field.coefficients, other.vesicle.fields.at(name).coefficients) << name;
  }

  std::set<std::string> temporary_files_of(const fs::path& run) const {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(work() / run))
      if (entry.path().extension() == ".tmp") names.insert(entry.path().string());
    return names;
  }
};

TEST_F(Resume, goes_on_to_the_last_bit_after_an_interrupt) {
  for (const std::string scene : {one_phase, two_phases}) {
    ASSERT_EQ(run(scene + " -o whole --force").code, 0);
    // a pause in which the run waits for the signal, however fast the machine is
    const Program program(
        words("run --no-pictures " + scene + " -o run --force"),
        with_fault("renameat:frame_0001.hdf 1 signal " + std::to_string(SIGSTOP)));
    ASSERT_TRUE(
        comes_true([&] { return fs::exists(work() / "run" / "frames" / "frame_0000.hdf"); }));
    program.wait_until_stopped();
    program.signal(SIGTERM);
    program.signal(SIGCONT);
    const Result result = program.wait();
    EXPECT_EQ(result.code, 75) << result.err;
    EXPECT_EQ(read_status(work() / "run" / "status.toml").state, RunStatus::State::interrupted);
    const Result resumed = run("--resume run --threads 1");
    EXPECT_EQ(resumed.code, 0) << resumed.err;
    expect_same_run("whole", "run");
  }
}

/// At any call that changes a file or a folder, in the order of these: of the first start, of what
/// goes on with it, and of what replaces it.
TEST_F(Resume, survives_being_killed_at_any_time) {
  const std::string scene =
                        std::string(one_phase) + " --set run.end_time=1e-4 --set output.frames=3",
                    command = scene + " --checkpoint-every 1e-9 --resume ";
  ASSERT_EQ(run(command + "whole").code, 0);
  const auto killed_at = [&](int count, const std::string& arguments) {
    const Result result = Program(words("run --no-pictures " + arguments),
                                  with_fault(fmt::format("change {} signal {}", count, SIGKILL)))
                              .wait();
    EXPECT_THAT(result.code, testing::AnyOf(-SIGKILL, 0)) << result.err;
    return result.code == -SIGKILL;
  };
  int kills = 0;
  for (int count = 1;; count += 1 + count / 3) {
    SCOPED_TRACE(count);
    const std::string name = "run" + std::to_string(count);
    if (!killed_at(count, command + name)) break;
    killed_at(count, command + name);
    const Result result = run(command + name);
    EXPECT_EQ(result.code, 0) << result.err;
    expect_same_run("whole", name);
    write(work() / name / "note.txt", "precious");
    killed_at(count, scene + " --force -o " + name);
    EXPECT_EQ(text_of(work() / name / "note.txt"), "precious");
    const Result again = run(command + name);
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(text_of(work() / name / "history.csv"), text_of(work() / "whole" / "history.csv"));
    EXPECT_THAT(temporary_files_of(name), IsEmpty());
    kills++;
  }
  EXPECT_GT(kills, 8);
}

TEST_F(Resume, begins_again_where_there_is_no_checkpoint_yet) {
  ASSERT_EQ(run(std::string(one_phase) + " -o whole").code, 0);
  ASSERT_EQ(run(std::string(one_phase) + " -o run --checkpoint-every 0").code, 0);
  fs::remove(work() / "run" / "status.toml");
  write(work() / "run" / ".status.toml.123-4.tmp", "half");
  write(work() / "run" / "frames" / ".frame_0003.hdf.123-5.tmp", "half");
  EXPECT_EQ(run("--resume run").code, 0);
  expect_same_run("whole", "run");
  EXPECT_THAT(temporary_files_of("run"), IsEmpty());
}

TEST_F(Resume, falls_back_where_the_newest_checkpoint_is_damaged) {
  ASSERT_EQ(run(std::string(one_phase) + " -o whole").code, 0);
  const Program program(
      words(std::string("run --no-pictures --checkpoint-every 0.05 -o run ") + one_phase),
      setting_);
  wait_for_checkpoints("run", 2);
  program.signal(SIGKILL);
  program.wait();
  const fs::path newest = checkpoints_of("run").back();
  fs::resize_file(newest, fs::file_size(newest) / 2);
  const Result result = run("--resume run");
  EXPECT_EQ(result.code, 0);
  EXPECT_THAT(result.err, AllOf(HasSubstr(newest.filename().string()), HasSubstr("cut off"),
                                HasSubstr("falling back to the state before")));
  expect_same_run("whole", "run");
}

TEST_F(Resume, makes_checkpoints_on_demand_and_keeps_two) {
  const Program program(words(std::string("run --no-pictures -o run ") + one_phase +
                              " --set run.end_time=1 --set grid.nodes=32"),
                        setting_);
  wait_for_rows(work() / "run");
  std::set<fs::path> seen;
  for (int i = 0; i < 3; i++) {
    const auto before = checkpoints_of("run");
    program.signal(SIGUSR1);
    ASSERT_TRUE(comes_true([&] { return checkpoints_of("run") != before; }));
    for (const fs::path& file : checkpoints_of("run")) seen.insert(file);
  }
  program.interrupt();
  EXPECT_EQ(program.wait().code, 75);
  EXPECT_GE(seen.size(), 3u);
  EXPECT_EQ(checkpoints_of("run").size(), 2u);
}

TEST_F(Resume, refuses_a_changed_scene_and_says_what_changed) {
  cut_short(std::string(one_phase) + " -o run --checkpoint-every 0.02");
  const Result result =
      run("--resume run --set run.end_time=0.002 --set membrane.bending_modulus=2");
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("the scene is not that of the run"),
                    HasSubstr("[membrane] bending_modulus: 1 -> 2"),
                    HasSubstr("[run] end_time: 0.0008 -> 0.002"), HasSubstr("--branch")));
  EXPECT_EQ(run("--resume run").code, 0) << "it was left alone";
}

TEST_F(Resume, branches_off_with_a_changed_scene) {
  const std::string limit = " --set numerics.max_time_step=2e-5"; // follows the end time otherwise
  ASSERT_EQ(run(one_phase + limit + " -o short").code, 0);
  const std::string before = text_of(work() / "short" / "history.csv");
  const Result result = run("--resume short --branch -o long --set run.end_time=1e-3");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto history = read_history(work() / "long" / "history.csv");
  EXPECT_EQ(history.front().time, 8e-4);
  EXPECT_EQ(history.back().time, 1e-3);
  EXPECT_LT(history.back().energy, history.front().energy);
  EXPECT_EQ(text_of(work() / "short" / "history.csv"), before);
  EXPECT_THAT(read_status(work() / "long" / "status.toml").origin, HasSubstr("short, t = 0.0008"));

  EXPECT_EQ(run("--resume short --branch -o softer --set run.end_time=9e-4 "
                "--set membrane.bending_modulus=0.5")
                .code,
            0);
  const Result refused = run("--resume short --branch -o other --set grid.nodes=32");
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("[grid] nodes: 24 -> 32"), HasSubstr("no branch")));
  EXPECT_FALSE(fs::exists(work() / "other"));
  EXPECT_THAT(run("--resume short --branch -o other").err, HasSubstr("set run.end_time beyond it"));
}

TEST_F(Resume, branches_off_from_any_exact_frame) {
  for (const std::string scene : {one_phase, two_phases}) {
    ASSERT_EQ(run(scene + " -o whole --exact-frames --force").code, 0);
    const Result result =
        run("--resume whole/frames/frame_0002.hdf --branch -o rest --force --threads 1");
    ASSERT_EQ(result.code, 0) << result.err;
    const std::string whole = text_of(work() / "whole" / "history.csv"),
                      rest = text_of(work() / "rest" / "history.csv");
    const std::string rows = rest.substr(rest.find('\n') + 1);
    EXPECT_TRUE(whole.ends_with(rows)) << rows;
    EXPECT_GT(std::ranges::count(rows, '\n'), 5);
    EXPECT_THAT(call({"inspect", "whole/frames/frame_0001.hdf"}).out, HasSubstr("a checkpoint"));
  }
  EXPECT_THAT(run("--resume whole/frames/frame_0000.hdf --branch -o other").err,
              HasSubstr("a frame without a checkpoint"));
  EXPECT_THAT(run("--resume whole/frames/frame_0002.hdf").err, HasSubstr("--branch"));
  fs::rename(work() / "whole" / "frames" / "frame_0002.hdf", work() / "frame.hdf");
  EXPECT_THAT(run("--resume frame.hdf --branch -o other").err, HasSubstr("not in the folder"));
}

TEST_F(Resume, leaves_finished_runs_and_folders_in_use_alone) {
  ASSERT_EQ(run(std::string(one_phase) + " -o run").code, 0);
  const std::string summary = text_of(work() / "run" / "summary.txt");
  const Result again = run("--resume run");
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(again.out, HasSubstr("nothing is left to do"));
  EXPECT_EQ(text_of(work() / "run" / "summary.txt"), summary);

  const Program program(words(std::string("run --no-pictures -o busy --checkpoint-every 0.02 ") +
                              one_phase + " --set run.end_time=1"),
                        setting_);
  wait_for_checkpoints("busy", 1);
  Setting other = setting_;
  other.folder = work() / "beside";
  fs::create_directory(other.folder);
  const Result refused = Program(words("run --resume ../busy"), other).wait();
  program.signal(SIGKILL);
  program.wait();
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("another lamella is writing to this folder"));
}

TEST_F(Resume, goes_on_when_the_disk_has_room_again) {
  ASSERT_EQ(run(std::string(one_phase) + " -o whole").code, 0);
  const std::string command =
      std::string("run --no-pictures -o run --checkpoint-every 0 ") + one_phase;
  setting_.largest_file = 30000; // less than a frame
  const Result full = call(words(command));
  EXPECT_EQ(full.code, 4);
  EXPECT_THAT(full.err, AllOf(HasSubstr("File too large"), HasSubstr("--resume run")));
  setting_.largest_file = RLIM_INFINITY;
  EXPECT_EQ(run("--resume run").code, 0);
  expect_same_run("whole", "run");
}

TEST_F(Resume, keeps_the_last_good_checkpoint_on_a_full_disk) {
  const fs::path disk = work() / "disk";
  fs::create_directory(disk);
  if (mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=3m") != 0)
    GTEST_SKIP() << "only root can mount a small disk";
  ASSERT_EQ(run(std::string(one_phase) + " -o whole").code, 0);
  const std::string many = " --set output.frames=9 --checkpoint-every 0.01";
  const Result full = run(std::string(one_phase) + many + " -o disk/run");
  if (full.code == 4) {
    EXPECT_THAT(full.err,
                AllOf(HasSubstr("No space left on device"), HasSubstr("--resume disk/run")));
    EXPECT_THAT(temporary_files_of("disk/run"), IsEmpty());
    EXPECT_EQ(mount("tmpfs", disk.c_str(), "tmpfs", MS_REMOUNT, "size=64m"), 0);
    EXPECT_EQ(run("--resume disk/run").code, 0);
    expect_same_run("whole", "disk/run");
  } else {
    ADD_FAILURE() << "the disk was large enough: " << full.err;
  }
  umount2(disk.c_str(), MNT_DETACH);
}

TEST_F(Resume, tells_what_is_stored) {
  ASSERT_EQ(run(std::string(one_phase) + " -o run").code, 0);
  const auto inspect = [&](const std::string& what) { return call({"inspect", what}); };
  EXPECT_THAT(inspect("run").out,
              AllOf(HasSubstr("fig3_oblate: Oblate to discocyte"), HasSubstr("24 x 24 x 24 nodes"),
                    HasSubstr("finished in"), HasSubstr("0.0008 of 0.0008"),
                    HasSubstr("9, to frame_"), HasSubstr("1, to checkpoint_")));
  EXPECT_THAT(inspect("run/frames/frame_0002.hdf").out,
              AllOf(HasSubstr("a frame"), HasSubstr("0.0002"), HasSubstr("phi (the membrane)")));
  EXPECT_THAT(inspect(checkpoints_of("run").back()).out,
              AllOf(HasSubstr("a checkpoint"), HasSubstr("0.0008 of 0.0008"), HasSubstr("energy"),
                    HasSubstr("kernels")));
  for (const char* what : {"nothing", ".", "run/history.csv"}) {
    const Result result = inspect(what);
    EXPECT_THAT(result.code, testing::AnyOf(2, 4)) << what;
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
  }
}

TEST_F(Resume, says_what_is_missing) {
  EXPECT_THAT(run("--resume nowhere").err, HasSubstr("there is no run to resume"));
  EXPECT_THAT(run("").err, HasSubstr("scene is required"));
  EXPECT_THAT(run("fig3_oblate --resume run -o other").err, HasSubstr("--branch"));
  EXPECT_THAT(run("fig3_oblate --branch").err, HasSubstr("--branch requires"));
}

} // namespace
} // namespace lamella
