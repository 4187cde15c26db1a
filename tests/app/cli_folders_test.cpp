// Whose files are whose: nothing of the user's is lost, inside the output folder and outside.
#include "cli.h"

#include "store/checkpoint.h"
#include "store/run_status.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace lamella {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;

using Contents = std::map<std::string, std::string>;

class Folders : public Cli {
protected:
  /// Refused with one sentence, and all files as they were.
  void expect_refused(const Arguments& arguments, int code, const std::string& part) const {
    const Contents before = contents_of(base_);
    const Result result = call(arguments);
    EXPECT_EQ(result.code, code) << result.err;
    EXPECT_THAT(result.err, AllOf(MatchesRegex("lamella: [^\n]+\n"), HasSubstr(part)));
    Contents after = contents_of(base_);
    for (const char* own : {"work.out", "work.err"})
      after[own] = before.contains(own) ? before.at(own) : "";
    Contents expected = before;
    for (const char* own : {"work.out", "work.err"}) expected.try_emplace(own, "");
    EXPECT_EQ(after, expected);
  }
  /// A run that can go on: with a frame, a checkpoint and surfaces.
  void make_interrupted_run() const {
    const Program program(slow("10", words("-o run --no-pictures --checkpoint-every 1e-9 --set "
                                           "output.frames=10000")),
                          setting_);
    wait_for_rows(work() / "run");
    program.interrupt();
    ASSERT_EQ(program.wait().code, 75);
    ASSERT_EQ(call(words("export run --times 0")).code, 0);
    write(work() / "run" / "figure.png", "old");
  }
  const Arguments anew = quick({"-o", "run", "--force"});
  const Arguments on = words("run --no-pictures --resume run");
};

// ------------------------------------------------------------------------------ two at a time

TEST_F(Folders, belong_to_the_start_that_came_first) {
  // stopped where it writes for the first time: its start is built, and the second one comes and
  // goes
  const Program first(quick({"-o", "run"}),
                      with_fault(fmt::format("renameat 1 signal {}", SIGSTOP)));
  first.wait_until_stopped();
  for (const Arguments& arguments :
       {quick({"-o", "run"}), quick({"-o", "run", "--force"}), quick({"--resume", "run"}),
        words("tradeoff sphere -o run"), words("extremes -o run --only sphere"),
        words("figure 3 -o run")}) {
    Setting setting = setting_;
    setting.folder = base_ / "elsewhere"; // for its words
    fs::create_directory(setting.folder);
    fs::create_directory_symlink(work() / "run", setting.folder / "run");
    const Result result = Program(arguments, setting).wait();
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.err, "lamella: run: another lamella is writing to this folder\n");
    fs::remove_all(setting.folder);
  }
  first.signal(SIGCONT);
  EXPECT_EQ(first.wait().code, 0);
  EXPECT_THAT(call(quick({"-o", "run"})).err, HasSubstr("the folder holds a run"));
}

TEST_F(Folders, are_looked_at_once_no_other_start_can_come_in_between) {
  const Program slower(quick({"-o", "run"}), with_fault(fmt::format("flock 1 signal {}", SIGSTOP)));
  slower.wait_until_stopped();
  Setting setting = setting_;
  setting.folder = work() / "run"; // which is there already
  ASSERT_EQ(Program(quick({"-o", "."}), setting).wait().code, 0);
  const Contents before = contents_of(work() / "run");
  slower.signal(SIGCONT);
  const Result result = slower.wait();
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("run: the folder holds a run"));
  EXPECT_TRUE(contents_of(work() / "run") == before);
}

TEST_F(Folders, are_not_replaced_while_something_is_made_of_their_runs) {
  ASSERT_EQ(call(quick({"-o", "run"})).code, 0);
  const Program exporting(
      words("export run"),
      with_fault(fmt::format("renameat:membrane_0001.vtp 1 signal {}", SIGSTOP)));
  exporting.wait_until_stopped();
  Setting setting = setting_;
  setting.folder = work() / "run"; // so that its words do not mix
  const Result result = Program(quick({"-o", ".", "--force"}), setting).wait();
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("another lamella is writing to this folder"));
  exporting.signal(SIGCONT);
  EXPECT_EQ(exporting.wait().code, 0);
}

TEST_F(Folders, that_a_start_made_in_vain_go_again) {
  EXPECT_EQ(
      call(words("run sphere -o a/b/run --set shape.kind=frame --set shape.file=nothing")).code, 2);
  write(work() / "far.toml", "[shape]\nkind = \"sphere\"\nradius = 0.05\n[grid]\nnodes = 16\n");
  EXPECT_EQ(call(words("run far.toml -o a/b/run")).code, 2) << "cannot start";
  EXPECT_THAT(names_in(work()), ElementsAre("far.toml"));
  fs::create_directory(work() / "mine");
  EXPECT_EQ(call(words("run far.toml -o mine")).code, 2);
  EXPECT_TRUE(fs::exists(work() / "mine"));
}

// -------------------------------------------------------------------------------- the user's files

TEST_F(Folders, with_a_scene_alone_hold_no_run) {
  const fs::path run = work() / "run";
  fs::create_directories(run / "frames");
  write(run / "scene.toml", call(words("scenes sphere")).out);
  for (const char* mine :
       {"summary.txt", "figure.png", "note.txt", "frames/frame_0000.hdf", "frames/my.hdf"})
    write(run / mine, "mine");
  expect_refused(on, 2, "there is no run to resume");
  expect_refused(anew, 2, "holds something else than a run, which --force leaves alone");
  expect_refused(words("run sphere --resume run"), 2, "the folder is not empty");
  for (const char* history : {"", "t,dt,energy,mine\n", "t,dt,energy\n0,0,1\n"}) {
    write(run / "history.csv", history);
    expect_refused(on, 2, "there is no run to resume");
    expect_refused(anew, 2, "--force leaves alone");
    expect_refused(words("inspect run"), 2, "holds no run");
  }
  write(run / "status.toml", "state = \"running\"\n");
  expect_refused(on, 2, "there is no run to resume");
}

TEST_F(Folders, whose_run_has_lost_its_scene_are_not_replaced) {
  ASSERT_EQ(call(quick({"-o", "run"})).code, 0);
  fs::rename(work() / "run" / "scene.toml", work() / "mine.toml"); // to change something in it
  expect_refused(words("run mine.toml -o run"), 2, "run: the folder is not empty");
  expect_refused(words("run mine.toml --resume run"), 2, "run: the folder is not empty");
  expect_refused(words("run mine.toml -o run --force"), 2, "--force leaves alone");
  fs::rename(work() / "mine.toml", work() / "run" / "scene.toml");
  EXPECT_EQ(call(on).code, 0);
}

TEST_F(Folders, with_a_status_alone_hold_no_run) {
  ASSERT_EQ(call(quick({"-o", "run"})).code, 0);
  const std::string status = text_of(work() / "run" / "status.toml");
  for (const char* mine : {"summary.txt", "history.csv", "figure.png", "frames/frame_0000.hdf",
                           "checkpoints/checkpoint_00000001.hdf"}) {
    fs::remove_all(work() / "run");
    fs::create_directories((work() / "run" / mine).parent_path());
    write(work() / "run" / mine, "mine");
    write(work() / "run" / "status.toml", status);
    expect_refused(quick({"-o", "run"}), 2, "run: the folder is not empty");
  }
}

TEST_F(Folders, keep_all_that_is_not_certainly_of_the_run) {
  make_interrupted_run();
  const fs::path run = work() / "run";
  const std::vector<const char*> mine{"note.txt",
                                      "movie.mp4",
                                      "figure.pdf",
                                      "frames/my.hdf",
                                      "frames/frame_1.hdf",
                                      "checkpoints/keep.hdf",
                                      "surfaces/membrane_0007.vtp",
                                      ".status.toml.swp"};
  for (const char* file : mine) write(run / file, "mine");
  EXPECT_EQ(call(words("run --no-pictures --resume run --set stop.wall_time=0.1")).code, 2);
  const Program program(on, setting_);
  ASSERT_TRUE(comes_true([&] { return !fs::exists(run / "summary.txt"); }));
  program.interrupt();
  EXPECT_EQ(program.wait().code, 75);
  for (const char* file : mine) EXPECT_EQ(text_of(run / file), "mine") << file;
  EXPECT_FALSE(fs::exists(run / "surfaces" / "membrane_0000.vtp"));
  ASSERT_EQ(call(anew).code, 0);
  for (const char* file : mine) EXPECT_EQ(text_of(run / file), "mine") << file;
  EXPECT_EQ(frames_of(run).size(), 7u);
}

TEST_F(Folders, refuse_a_frame_that_the_run_does_not_list) {
  make_interrupted_run();
  const fs::path next = fmt::format("frame_{:04}.hdf", frames_of(work() / "run").size());
  for (const fs::path& name : {fs::path("frame_9000.hdf"), next}) {
    const fs::path file = work() / "run" / "frames" / name;
    write(file, "mine");
    for (const Arguments& arguments : {anew, on})
      expect_refused(arguments, 4,
                     fmt::format("run/frames/{}: is not among the frames that frames.hdf.series "
                                 "lists",
                                 name.string()));
    fs::remove(file);
  }
  EXPECT_EQ(call(anew).code, 0);
}

TEST_F(Folders, receive_an_export_beside_other_surfaces) {
  ASSERT_EQ(call(quick({"-o", "run"})).code, 0);
  fs::create_directory(work() / "meshes");
  for (const char* file : {"membrane_0001.vtp", "membrane.pvd"}) {
    const fs::path mine = work() / "meshes" / file;
    write(mine, "mine");
    expect_refused(words("export run -o meshes"), 4,
                   fmt::format("meshes/{}: is there already", file));
    fs::remove(mine);
  }
  write(work() / "meshes" / "membrane_0100.vtp", "mine");
  EXPECT_EQ(call(words("export run -o meshes")).code, 0);
  EXPECT_EQ(call(words("export run -o meshes --times 0")).code, 0);
  EXPECT_THAT(names_in(work() / "meshes"),
              ElementsAre("membrane.pvd", "membrane_0000.vtp", "membrane_0100.vtp"));
}

TEST_F(Folders, receive_an_export_again_after_one_that_was_killed) {
  ASSERT_EQ(call(quick({"-o", "run"})).code, 0);
  for (int count = 1, code = -SIGKILL; code == -SIGKILL; count += 1 + count / 2) {
    code = Program(words("export run -o meshes"),
                   with_fault(fmt::format("change {} signal {}", count, SIGKILL)))
               .wait()
               .code;
    EXPECT_EQ(call(words("export run -o meshes --times 1e-5")).code, 0) << count;
    EXPECT_THAT(names_in(work() / "meshes"), ElementsAre("membrane.pvd", "membrane_0002.vtp"));
  }
}

// -------------------------------------------------------------------------------------- links

TEST_F(Folders, refuse_symbolic_links_in_place_of_their_own) {
  make_interrupted_run();
  const fs::path run = work() / "run", outside = base_ / "outside";
  for (const std::string own :
       {"scene.toml", "status.toml", "history.csv", "events.csv", "components.csv", "summary.txt",
        "figure.png", "energy.png", "start.hdf", "frames", "checkpoints", "surfaces",
        "frames/frame_0000.hdf", "frames/frames.hdf.series",
        "checkpoints/checkpoint_99999999.hdf"}) {
    const bool was_there = fs::exists(run / own);
    if (was_there)
      fs::rename(run / own, outside);
    else
      write(outside, "precious");
    for (const fs::path& target : {outside, base_ / "nothing"}) {
      fs::create_symlink(target, run / own);
      for (const Arguments& arguments : {anew, on}) {
        const Contents before = contents_of(base_);
        const Result result = call(arguments);
        EXPECT_THAT(result.code, testing::AnyOf(2, 4)) << own << result.err;
        EXPECT_THAT(result.err, MatchesRegex("(lamella: [^\n]+\n)+")) << "perhaps with warnings";
        if (target == outside) {
          EXPECT_THAT(result.err, HasSubstr("a symbolic link")) << own;
        }
        Contents after = contents_of(base_);
        for (const char* words : {"work.out", "work.err"}) after[words] = before.at(words);
        EXPECT_TRUE(after == before) << own;
      }
      fs::remove(run / own);
    }
    if (was_there)
      fs::rename(outside, run / own);
    else
      fs::remove(outside);
  }
  EXPECT_EQ(call(anew).code, 0) << "the run was left as it was";
}

TEST_F(Folders, export_nothing_through_links) {
  ASSERT_EQ(call(quick({"-o", "run"})).code, 0);
  fs::create_directory(base_ / "outside");
  write(base_ / "outside" / "membrane.pvd", "precious");
  fs::create_directory_symlink(base_ / "outside", work() / "run" / "surfaces");
  expect_refused(words("export run"), 4, "run/surfaces: is a symbolic link");
  fs::create_directory(work() / "meshes");
  fs::create_symlink(base_ / "outside" / "membrane.pvd", work() / "meshes" / "membrane.pvd");
  expect_refused(words("export run -o meshes"), 4, "meshes/membrane.pvd: is there already");
  EXPECT_EQ(text_of(base_ / "outside" / "membrane.pvd"), "precious");
}

TEST_F(Folders, draw_nothing_through_links) {
  ASSERT_EQ(call(quick({"-o", "run"})).code, 0);
  write(base_ / "outside.png", "precious");
  fs::create_symlink(base_ / "outside.png", work() / "run" / "figure.png");
  expect_refused(words("render run --width 200"), 4,
                 "run/figure.png: cannot be replaced: it is a symbolic link");
  fs::create_symlink(base_ / "outside.png", work() / "run" / "movie.mp4");
  expect_refused(words("movie run --seconds 0.1 --width 200 --height 200"), 4,
                 "run/movie.mp4: cannot be replaced: it is a symbolic link");
  EXPECT_EQ(text_of(base_ / "outside.png"), "precious");
}

TEST_F(Folders, sweep_and_tabulate_nothing_through_links) {
  write(base_ / "outside", "precious");
  for (const char* command : {"tradeoff", "extremes"}) {
    fs::create_directory(work() / command);
    fs::create_symlink(base_ / "outside", work() / command / fmt::format("{}.csv", command));
  }
  expect_refused(words("tradeoff sphere -o tradeoff --force --grids 16 --set run.end_time=1e-6"), 4,
                 "tradeoff.csv: cannot be replaced: it is a symbolic link");
  EXPECT_EQ(call(words("extremes -o extremes --quick --only sphere")).code, 4);
  EXPECT_EQ(text_of(base_ / "outside"), "precious");
  fs::create_directory(work() / "figures");
  fs::create_directory_symlink(base_, work() / "figures" / "runs");
  expect_refused(words("figure 3 -o figures"), 4, "figures/runs: is a symbolic link");
}

TEST_F(Folders, may_themselves_be_named_by_a_link) {
  fs::create_directory(base_ / "disk");
  fs::create_directory_symlink(base_ / "disk", work() / "run");
  EXPECT_EQ(call(quick({"-o", "run"})).code, 0);
  EXPECT_EQ(call(anew).code, 0);
  EXPECT_EQ(call(on).code, 0);
  EXPECT_TRUE(fs::exists(base_ / "disk" / "summary.txt"));
}

TEST_F(Folders, change_no_file_that_has_another_name_outside) {
  make_interrupted_run();
  fs::create_directory(base_ / "copy");
  for (const auto& entry : fs::recursive_directory_iterator(work() / "run"))
    if (entry.is_regular_file())
      fs::create_hard_link(entry.path(), base_ / "copy" / entry.path().filename());
  const Contents before = contents_of(base_ / "copy");
  const Program program(on, setting_);
  ASSERT_TRUE(comes_true([&] { return !fs::exists(work() / "run" / "summary.txt"); }));
  program.interrupt();
  EXPECT_EQ(program.wait().code, 75);
  EXPECT_TRUE(contents_of(base_ / "copy") == before);
  EXPECT_EQ(call(anew).code, 0);
  EXPECT_TRUE(contents_of(base_ / "copy") == before);
}

TEST_F(Folders, keep_their_run_where_they_may_not_be_written_to) {
  make_interrupted_run();
  setting_.without_privileges = true;
  for (const fs::path& folder :
       {work() / "run", work() / "run" / "frames", work() / "run" / "checkpoints"}) {
    for (const auto& entry : fs::recursive_directory_iterator(work() / "run"))
      fs::permissions(entry.path(), fs::perms(entry.is_directory() ? 0777 : 0666));
    fs::permissions(work() / "run", fs::perms(0777));
    fs::permissions(folder, fs::perms(0555));
    const Result trial = call({"--version"});
    if (trial.code == 126 || trial.code == 127)
      GTEST_SKIP() << "the program cannot be started without root's privileges here";
    for (const Arguments& arguments : {anew, on})
      expect_refused(arguments, 4, "cannot be written to: Permission denied");
  }
}

TEST_F(Folders, keep_the_run_when_a_new_one_cannot_be_written) {
  ASSERT_EQ(call(quick({"-o", "run"})).code, 0);
  setting_ = with_fault(fmt::format("write 1 fail {}", ENOSPC));
  expect_refused(anew, 4, "run/status.toml: cannot be written: No space left on device");
}

} // namespace
} // namespace lamella
