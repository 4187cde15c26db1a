// Signals from people, shells and job managers: a run ends with all that it has, at any time.
#include "cli.h"

#include "store/run_status.h"

#include <csignal>
#include <fmt/format.h>
#include <gmock/gmock.h>

namespace lamella {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class Signals : public Cli {
protected:
  std::size_t checkpoints(const fs::path& run) const {
    const fs::path folder = run / "checkpoints";
    return fs::exists(folder) ? names_in(folder).size() : 0;
  }
};

constexpr int ending[]{SIGINT, SIGTERM, SIGHUP, SIGUSR2, SIGXCPU};

TEST_F(Signals, end_a_run_with_a_checkpoint) {
  for (const int signal : ending) {
    SCOPED_TRACE(strsignal(signal));
    const fs::path run = work() / fmt::format("run{}", signal);
    const Program program(slow("10", words("--no-pictures -o", {run.filename()})), setting_);
    wait_for_rows(run);
    program.signal(signal);
    EXPECT_EQ(program.wait().code, 75);
    EXPECT_EQ(checkpoints(run), 1u);
    EXPECT_EQ(read_status(run / "status.toml").state, RunStatus::State::interrupted);
  }
}

TEST_F(Signals, of_job_managers_may_come_in_numbers) {
  const Program program(slow("10", words("-o run --no-pictures")),
                        with_fault(fmt::format("renameat:summary.txt 1 signal {}", SIGSTOP)));
  wait_for_rows(work() / "run");
  for (const int signal : {SIGXCPU, SIGUSR2, SIGTERM, SIGHUP, SIGUSR1}) program.signal(signal);
  program.wait_until_stopped(); // while it stores what there is
  for (const int signal : {SIGTERM, SIGXCPU, SIGXCPU, SIGHUP}) program.signal(signal);
  program.signal(SIGCONT);
  EXPECT_EQ(program.wait().code, 75);
  EXPECT_TRUE(fs::exists(work() / "run" / "summary.txt"));
}

TEST_F(Signals, from_the_keyboard_end_the_program_at_once_the_second_time) {
  const Program program(slow("10", words("-o run --no-pictures")),
                        with_fault(fmt::format("renameat:summary.txt 1 signal {}", SIGSTOP)));
  wait_for_rows(work() / "run");
  program.interrupt();
  program.wait_until_stopped();
  program.interrupt();
  program.signal(SIGCONT);
  EXPECT_EQ(program.wait().code, -SIGINT);
}

TEST_F(Signals, are_ignored_where_the_program_was_started_to_ignore_them) {
  setting_.ignored = {SIGHUP, SIGINT, SIGUSR1, SIGUSR2};
  const Program program(slow("0.003", words("-o run --no-pictures --checkpoint-every 0")),
                        setting_);
  wait_for_rows(work() / "run");
  for (const int signal : setting_.ignored) program.signal(signal);
  EXPECT_EQ(program.wait().code, 0);
  EXPECT_EQ(checkpoints(work() / "run"), 0u);
}

TEST_F(Signals, are_heard_before_the_program_does_anything_else) {
  for (const int signal : ending) { // with the first file that main() opens
    const Result result =
        Program(quick({"-o", "run"}), with_fault(fmt::format("open:/dev/null 1 signal {}", signal)))
            .wait();
    EXPECT_EQ(result.code, 130) << strsignal(signal) << result.err;
    EXPECT_EQ(result.err, "lamella: interrupted before the run began; nothing was written\n");
    EXPECT_THAT(names_in(work()), IsEmpty());
  }
}

TEST_F(Signals, are_heard_at_any_time) {
  for (int count = 1, code = 130; code != 0; count += 1 + count / 2) {
    const Result result = Program(quick({"-o", "run"}),
                                  with_fault(fmt::format("change {} signal {}", count, SIGTERM)))
                              .wait();
    code = result.code;
    EXPECT_THAT(code, testing::AnyOf(0, 75, 130)) << count << result.err;
    if (code == 130) {
      EXPECT_THAT(names_in(work()), IsEmpty()) << count;
    }
    if (code == 75) {
      check_stored(work() / "run");
      EXPECT_EQ(call(words("run --no-pictures --resume run")).code, 0) << count;
    }
    fs::remove_all(work() / "run");
  }
}

TEST_F(Signals, are_heard_while_a_start_is_built) {
  // the folder is claimed before, so that this says when
  const Program program(words("run fig3_oblate --no-pictures --set grid.nodes=256 -o run"),
                        with_fault(fmt::format("flock 1 signal {}", SIGSTOP)));
  program.wait_until_stopped();
  program.signal(SIGCONT);
  program.signal(SIGTERM);
  const Result result = program.wait();
  EXPECT_EQ(result.code, 130);
  EXPECT_EQ(result.err, "lamella: interrupted before the run began; nothing was written\n");
  EXPECT_THAT(names_in(work()), IsEmpty());
}

TEST_F(Signals, before_a_run_goes_on_leave_it_as_it_was) {
  const Program program(slow("10", words("-o run --no-pictures")), setting_);
  wait_for_rows(work() / "run");
  program.interrupt();
  ASSERT_EQ(program.wait().code, 75);
  const auto before = contents_of(work());
  const Result result = Program(words("run --no-pictures --resume run"),
                                with_fault(fmt::format("open:/dev/null 1 signal {}", SIGTERM)))
                            .wait();
  EXPECT_EQ(result.code, 75);
  EXPECT_EQ(result.err,
            "lamella: interrupted before the run went on; `lamella run --resume run` does\n");
  EXPECT_TRUE(contents_of(work()) == before);
}

TEST_F(Signals, end_what_has_nothing_to_store) {
  ASSERT_EQ(call(quick({"-o", "run"})).code, 0);
  for (const char* arguments : {"scenes", "inspect run", "render run"})
    EXPECT_EQ(
        Program(words(arguments), with_fault(fmt::format("open:/dev/null 1 signal {}", SIGTERM)))
            .wait()
            .code,
        -SIGTERM)
        << arguments;
}

TEST_F(Signals, of_a_reader_that_went_away_do_not_end_a_run) {
  setting_.no_reader = true;
  EXPECT_EQ(call(quick({"-o", "run"})).code, 0);
  EXPECT_TRUE(fs::exists(work() / "run" / "summary.txt"));
  EXPECT_EQ(call({"scenes"}).code, -SIGPIPE) << "as other programs that list something";
}

} // namespace
} // namespace lamella
