// The thread that writes. These tests use no other threads, so that ThreadSanitizer, which does not
// know how TBB shares its work, can be believed.
#include "parallel.h"
#include "runs.h"
#include "scene/builtin.h"
#include "store/background.h"
#include "store/checkpoint.h"
#include "version.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <unistd.h>
#include <vector>

namespace lamella {
namespace {

namespace fs = std::filesystem;

class Writer : public testing::Test {
protected:
  void SetUp() override {
    set_thread_count(1);
    folder_ = fs::temp_directory_path() / ("lamella background " + std::to_string(::getpid()));
    fs::create_directory(folder_);
  }
  void TearDown() override {
    fs::remove_all(folder_);
    set_thread_count(0);
  }
  fs::path folder_;
};

Checkpoint checkpoint_of(const Simulation& sim) {
  Checkpoint checkpoint;
  checkpoint.program = version();
  checkpoint.state = sim.state();
  return checkpoint;
}

TEST_F(Writer, StoresStatesWhileTheSimulationGoesOn) {
  Scene scene = builtin_scene("fig3_oblate");
  scene.nodes = {24, 24, 24};
  Simulation sim(scene);
  std::vector<Frame> states;
  Background writing;
  const auto file = [&](std::size_t n) { return folder_ / (std::to_string(n) + ".hdf"); };
  for (std::size_t n = 0; n < 6; n++) {
    sim.step(scene.end_time);
    states.push_back(sim.frame());
    writing.start([file = file(n), frame = sim.frame(), checkpoint = checkpoint_of(sim)]() mutable {
      write_checkpoint(file, frame, std::move(checkpoint));
    });
  }
  writing.wait();
  for (std::size_t n = 0; n < states.size(); n++) {
    const Frame stored = read_frame(file(n));
    EXPECT_EQ(stored.time, states[n].time);
    EXPECT_EQ(stored.phi, states[n].phi);
  }
}

TEST_F(Writer, SaysAtTheNextTaskWhatWentWrong) {
  Background writing;
  writing.start([] { throw std::runtime_error("the disk is full"); });
  EXPECT_THROW(writing.start([] {}), std::runtime_error);
  EXPECT_NO_THROW(writing.wait()); // it has been said
}

} // namespace
} // namespace lamella
