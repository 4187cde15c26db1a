// Files that are damaged or no files, and file systems that cannot do all.
#include "cli.h"

#include "store/checkpoint.h"

#include <cerrno>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/stat.h>

namespace lamella {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::MatchesRegex;

class Files : public Cli {
protected:
  /// With some frames, every fifth step.
  void run_and_interrupt(const std::string& more) const {
    const Program program(
        slow("0.1", words("-o run --no-pictures --set output.frames=2001 " + more)), setting_);
    ASSERT_TRUE(comes_true([&] { return fs::exists(run() / "frames" / "frame_0003.hdf"); }));
    program.interrupt();
    ASSERT_EQ(program.wait().code, 75);
  }
  fs::path run() const { return work() / "run"; }
  /// Changes a byte in the middle.
  static void damage(const fs::path& file) {
    std::string text = text_of(file);
    char& middle = text[text.size() / 2];
    middle = middle == '1' ? '2' : '1';
    write(file, text);
  }
};

// ----------------------------------------------------------------------------------- damaged runs

TEST_F(Files, that_are_damaged_are_named_when_a_run_goes_on) {
  run_and_interrupt("");
  const auto whole = contents_of(run());
  for (const char* file :
       {"history.csv", "events.csv", "components.csv", "frames/frame_0001.hdf"}) {
    damage(run() / file);
    const auto before = contents_of(run());
    const Result result = call(words("run --no-pictures --resume run"));
    EXPECT_EQ(result.code, 4);
    EXPECT_THAT(result.err,
                AllOf(MatchesRegex("lamella: [^\n]+\n"), HasSubstr(fmt::format("run/{}: ", file)),
                      HasSubstr("damaged"),
                      HasSubstr("begin again with `lamella run run/scene.toml -o run --force`")));
    EXPECT_TRUE(contents_of(run()) == before);
    write(run() / file, whole.at(file));
  }
  fs::remove(run() / "frames" / "frame_0001.hdf");
  EXPECT_THAT(call(words("run --resume run")).err,
              HasSubstr("frame_0001.hdf: cannot be read: No such"));
  EXPECT_EQ(call(words("run run/scene.toml -o run --force --no-pictures --set run.end_time=1e-4 "
                       "--set output.frames=2"))
                .code,
            0)
      << "the advice works";
}

TEST_F(Files, that_are_damaged_come_again_from_the_checkpoint_before_them) {
  const std::string more = " --no-pictures --set output.frames=7 --checkpoint-every 1e-9";
  ASSERT_EQ(call(slow("3e-4", words("-o whole" + more))).code, 0);
  // killed with checkpoints after 14 steps and after 15, which made a frame
  ASSERT_EQ(
      Program(slow("3e-4", words("-o run" + more)),
              with_fault(fmt::format("renameat:checkpoint_00000016.hdf 1 signal {}", SIGKILL)))
          .wait()
          .code,
      -SIGKILL);
  damage(run() / "frames" / "frame_0003.hdf");
  const Result result = call(words("run --no-pictures --resume run"));
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("frame_0003.hdf: cannot be read as a frame: it is damaged"),
                    HasSubstr("falling back to the state before")));
  for (const char* file : {"history.csv", "frames/frame_0003.hdf", "frames/frames.hdf.series"})
    EXPECT_TRUE(text_of(run() / file) == text_of(work() / "whole" / file)) << file;
}

TEST_F(Files, that_are_damaged_are_named_for_finished_runs_too) {
  ASSERT_EQ(call(quick({"-o", "run"})).code, 0);
  damage(run() / "frames" / "frame_0002.hdf");
  const Result result = call(words("run --resume run"));
  EXPECT_EQ(result.code, 4);
  EXPECT_THAT(result.err, AllOf(HasSubstr("frame_0002.hdf"), HasSubstr("begin again")));
}

TEST_F(Files, that_say_what_became_of_a_run_may_be_damaged_or_missing_alike) {
  ASSERT_EQ(call(quick({"-o", "whole"})).code, 0);
  for (const char* status : {"", "garbage [", "state = \"finished\"\n", "\xff\xfe"}) {
    ASSERT_EQ(call(quick({"-o", "run", "--force"})).code, 0);
    write(run() / "status.toml", status);
    EXPECT_THAT(call(words("inspect run")).err, HasSubstr("taken for one that was killed"));
    const Result result = call(words("run --no-pictures --resume run"));
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("run/status.toml: not the status of a run; the run is taken "
                                      "for one that was killed"));
    EXPECT_EQ(text_of(run() / "history.csv"), text_of(work() / "whole" / "history.csv"));
    EXPECT_THAT(text_of(run() / "status.toml"), HasSubstr("finished"));
  }
  fs::remove(run() / "status.toml");
  EXPECT_EQ(call(words("run --no-pictures --resume run")).code, 0);
}

TEST_F(Files, of_a_branch_without_a_checkpoint_are_not_taken_for_a_run_from_its_scene) {
  ASSERT_EQ(call(quick({"-o", "run"})).code, 0);
  const std::string branch =
      "run --no-pictures --resume run --branch -o branch --set run.end_time=4e-5";
  EXPECT_EQ(
      Program(words(branch), with_fault(fmt::format("mkdirat:checkpoints 1 signal {}", SIGKILL)))
          .wait()
          .code,
      -SIGKILL);
  const Result result = call(words("run --resume branch"));
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("branch: this branch of run, t = 2e-05 has no checkpoint"),
                    HasSubstr("--branch and --force")));
  EXPECT_EQ(call(words(branch + " --force")).code, 0) << "the advice works";
}

// ------------------------------------------------------------------------------- files that are
// none

TEST_F(Files, that_are_none_are_refused_by_every_command_without_waiting) {
  ASSERT_EQ(call(quick({"-o", "run"})).code, 0);
  fs::create_directory(work() / "folder");
  ASSERT_EQ(mkfifo((work() / "pipe").c_str(), 0666), 0);
  fs::create_symlink("nothing", work() / "link");
  fs::create_symlink("loop", work() / "loop");
  for (const std::string name :
       {"./folder", "./pipe", "/dev/zero", "./link", "./loop", "./nothing"})
    for (const std::string command :
         {"run {}", "run --resume {}",
          "run run/scene.toml --set shape.kind=frame --set shape.file={}", "inspect {}",
          "render {}", "movie {}", "export {}", "figure {}", "tradeoff {}",
          "tradeoff fig3_oblate --reference {}"}) {
      const Result result = call(words(fmt::format(fmt::runtime(command), name)));
      EXPECT_THAT(result.code, AnyOf(2, 4)) << command << " " << name;
      EXPECT_THAT(result.err, AllOf(MatchesRegex("lamella: [^\n]+\n"), HasSubstr(name.substr(2)),
                                    testing::Not(HasSubstr("unexpected"))))
          << command << " " << name;
    }
}

TEST_F(Files, of_a_run_that_are_none_are_named) {
  ASSERT_EQ(call(quick({"-o", "run"})).code, 0);
  for (const std::string file : {"history.csv", "events.csv", "components.csv", "scene.toml",
                                 "frames/frame_0001.hdf", "frames/frames.hdf.series"}) {
    fs::rename(run() / file, work() / "kept");
    for (const char* kind : {"folder", "pipe", "link"}) {
      if (*kind == 'f') fs::create_directory(run() / file);
      if (*kind == 'p') mkfifo((run() / file).c_str(), 0666);
      if (*kind == 'l') fs::create_symlink("nothing", run() / file);
      for (const char* command :
           {"inspect run", "run --resume run", "run run/scene.toml -o run --force"}) {
        const Result result = call(words(command));
        EXPECT_THAT(result.code, AnyOf(2, 4)) << command << " " << kind << " " << file;
        EXPECT_THAT(result.err,
                    AllOf(MatchesRegex("lamella: [^\n]+\n"), testing::Not(HasSubstr("unexpected"))))
            << command << " " << kind << " " << file;
      }
      fs::remove(run() / file);
    }
    fs::rename(work() / "kept", run() / file);
  }
  EXPECT_EQ(call(words("run --resume run")).code, 0) << "the run was left as it was";
}

// ------------------------------------------------------------------------------------ file systems

TEST_F(Files, lie_on_file_systems_that_cannot_synchronise_or_lock) {
  for (const int error : {EINVAL, ENOSYS, ENOTSUP}) {
    const Result result =
        Program(quick({"-o", "run", "--force"}), with_fault(fmt::format("fsync 0 fail {}", error)))
            .wait();
    EXPECT_EQ(result.code, 0) << result.err;
    check_stored(run());
  }
  for (const int error : {ENOLCK, ENOSYS, EINVAL, EBADF})
    EXPECT_EQ(
        Program(quick({"-o", "run", "--force"}), with_fault(fmt::format("flock 0 fail {}", error)))
            .wait()
            .code,
        0);
  const Result broken =
      Program(quick({"-o", "run", "--force"}), with_fault(fmt::format("fsync 0 fail {}", EIO)))
          .wait();
  EXPECT_EQ(broken.code, 4);
  EXPECT_THAT(broken.err, HasSubstr("cannot be written to the disk: Input/output error"));
}

TEST_F(Files, are_whole_whenever_the_disk_is_full) {
  ASSERT_EQ(call(quick({"-o", "whole"})).code, 0);
  for (int count = 1, code = 4; code != 0; count += 1 + count / 3) {
    const Result full = Program(quick({"--resume", "run"}),
                                with_fault(fmt::format("write {} fail {}", count, ENOSPC)))
                            .wait();
    code = full.code;
    EXPECT_THAT(code, AnyOf(0, 4)) << count << full.err;
    if (code == 4) {
      EXPECT_THAT(full.err, HasSubstr("No space left on device"));
    }
    if (fs::exists(run() / "history.csv")) check_stored(run());
    const Result result = call(quick({"--resume", "run"}));
    EXPECT_EQ(result.code, 0) << count << result.err;
    EXPECT_EQ(text_of(run() / "history.csv"), text_of(work() / "whole" / "history.csv")) << count;
    fs::remove_all(run());
  }
}

} // namespace
} // namespace lamella
