#include "error.h"
#include "runs.h"
#include "scene/builtin.h"
#include "store/checkpoint.h"
#include "store/frame_h5.h"
#include "version.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <functional>
#include <sys/resource.h>
#include <unistd.h>

namespace lamella {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void put(const fs::path& file, std::string_view content) {
  std::ofstream(file, std::ios::binary) << content;
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const StoreError& error) {
    return error.what();
  }
  return "no StoreError";
}

Scene one_phase() {
  Scene scene = builtin_scene("fig3_oblate");
  scene.nodes = {24, 24, 24};
  return scene;
}

Scene two_phases_with_stretch() {
  Scene scene = builtin_scene("fig9");
  scene.nodes = {32, 32, 32};
  scene.stretch.modulus = 1000;
  return scene;
}

class Checkpoints : public testing::Test {
protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("lamella checkpoints " + std::to_string(::getpid()));
    fs::create_directory(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path file() const { return folder_ / "checkpoint_00000003.hdf"; }

  /// After three steps.
  static Checkpoint after_steps(Simulation& sim) {
    for (int i = 0; i < 3; i++) sim.step(1);
    return {"title = \"a scene\"\n",
            std::string(version()),
            arithmetic(),
            2,
            1.5,
            {123, -7},
            {45, 1L << 60},
            {67, 8},
            {0, 1e-5},
            {171.5, 2},
            sim.state()};
  }

  /// A file of one phase after three steps.
  void store() const {
    Simulation sim(one_phase());
    const Checkpoint checkpoint = after_steps(sim);
    write_checkpoint(file(), sim.frame(), checkpoint);
  }

  std::string message_for(std::string_view content) const {
    put(file(), content);
    return message_of([&] { read_checkpoint(file()); });
  }

  /// A frame with whatever is put into the group of the checkpoint.
  std::string message_for(const std::function<void(hid_t group)>& fill) const {
    Simulation sim(one_phase());
    write_h5(Place(file()), 1 << 20, [&](hid_t root) {
      put_frame(root, sim.frame());
      const H5Handle lamella = owned(H5Gopen2(root, "lamella", H5P_DEFAULT));
      fill(create_group(lamella, "checkpoint"));
    });
    return message_of([&] { read_checkpoint(file()); });
  }

  fs::path folder_;
};

/// Two balls of different size.
Start two_balls(const Grid& grid) {
  Start start;
  for (std::size_t n = 0; n < grid.size(); n++) {
    const auto [x, y, z] = grid.position(n);
    start.phi.push_back(
        std::min(std::hypot(x - 0.45, y, z) - 0.3, std::hypot(x + 0.4, y, z) - 0.4));
  }
  return start;
}

TEST_F(Checkpoints, BringSeveralVesiclesBackToTheLastBit) {
  Scene scene = one_phase();
  scene.nodes = {32, 32, 32};
  Simulation sim(scene, two_balls(scene.grid()));
  write_checkpoint(file(), sim.frame(), after_steps(sim));
  Checkpoint back = read_checkpoint(file());
  Simulation again(scene, back.state);
  ASSERT_EQ(again.vesicles(), 2);
  for (int i = 0; i < 5; i++) {
    sim.step(1);
    again.step(1);
    EXPECT_EQ(again.component_measures(), sim.component_measures());
  }
  for (int& vesicle : back.state.vesicle.vesicle_of_node) vesicle = std::min(vesicle, 0);
  EXPECT_THROW(Simulation(scene, back.state), RunError) << "one of them is nowhere";
}

TEST_F(Checkpoints, BringARunBackToTheLastBit) {
  for (const Scene& scene : {one_phase(), two_phases_with_stretch()}) {
    Simulation sim(scene);
    const Checkpoint written = after_steps(sim);
    write_checkpoint(file(), sim.frame(), written);
    const Checkpoint back = read_checkpoint(file());
    EXPECT_EQ(back.scene, written.scene);
    EXPECT_EQ(back.program, version());
    EXPECT_EQ(back.arithmetic, arithmetic());
    EXPECT_EQ(back.threads, 2);
    EXPECT_EQ(back.wall_seconds, 1.5);
    EXPECT_EQ(back.history, written.history);
    EXPECT_EQ(back.events, written.events);
    EXPECT_EQ(back.components, written.components);
    EXPECT_EQ(back.frame_times, written.frame_times);
    EXPECT_EQ(back.stopping.energy_before, 171.5);
    EXPECT_EQ(back.stopping.steps_at_rest, 2);
    Simulation again(scene, back.state);
    for (int i = 0; i < 5; i++) {
      sim.step(1);
      again.step(1);
      EXPECT_EQ(again.time(), sim.time());
      EXPECT_EQ(again.measures().energy, sim.measures().energy);
    }
    EXPECT_EQ(again.frame().phi, sim.frame().phi);
    EXPECT_EQ(again.frame().fields, sim.frame().fields);
    EXPECT_TRUE(std::ranges::equal(again.events(), sim.events()));
  }
}

TEST_F(Checkpoints, KeepEventsAndWhatIsAboutToHappen) {
  Simulation sim(one_phase());
  Checkpoint written = after_steps(sim);
  Event event;
  event.kind = Event::Kind::recentred;
  event.time = 0.1;
  event.place = {1. / 3, -0.0, 1e-300};
  event.cells = {-4, 0, 7};
  written.state.events = {Event{}, event};
  written.state.domains = {{true, {0.1, 0.2, 0.3}, 0.4}};
  written.state.inside.assign(1, {.radius = 0.07, .around = {}});
  written.state.why_not_on = "the topology is about to change";
  write_checkpoint(file(), sim.frame(), written);
  const SimulationState back = read_checkpoint(file()).state;
  EXPECT_EQ(back.events, written.state.events);
  ASSERT_EQ(back.domains.size(), 1u);
  EXPECT_EQ(back.domains[0].center, written.state.domains[0].center);
  ASSERT_EQ(back.inside.size(), 1u);
  EXPECT_EQ(back.inside[0].radius, 0.07);
  Simulation again(one_phase(), back);
  EXPECT_THROW(again.step(1), RunError);
}

TEST_F(Checkpoints, AreFramesToo) {
  Simulation sim(two_phases_with_stretch());
  const Checkpoint checkpoint = after_steps(sim);
  write_checkpoint(file(), sim.frame(), checkpoint);
  const Frame frame = read_frame(file());
  EXPECT_EQ(frame.time, sim.time());
  EXPECT_EQ(frame.phi, sim.frame().phi);
  EXPECT_EQ(frame.fields.at("psi"), sim.frame().fields.at("psi"));
  const std::string first = content_of(file());
  write_checkpoint(file(), sim.frame(), checkpoint);
  EXPECT_EQ(content_of(file()), first) << "equal checkpoints make equal files";
}

TEST_F(Checkpoints, FitTheirSceneOnly) {
  Simulation sim(one_phase());
  const SimulationState state = after_steps(sim).state;
  const auto message = [&](auto change) {
    Scene scene = one_phase();
    SimulationState other = state;
    change(scene, other);
    try {
      Simulation(scene, other);
    } catch (const RunError& e) {
      return std::string(e.what());
    }
    return std::string("fits");
  };
  EXPECT_EQ(message([](Scene&, SimulationState&) {}), "fits");
  EXPECT_THAT(message([](Scene& s, auto&) {
                s.nodes = {24, 24, 26};
              }),
              HasSubstr("phi has 13824 values, not 14976"));
  EXPECT_THAT(message([](Scene& s, auto&) { s.area_difference.constraint = Constraint::fixed; }),
              HasSubstr("the list of responses has 1 values, not 2"));
  EXPECT_THAT(message([](Scene& s, auto&) { s.stretch.modulus = 1; }), HasSubstr("c is missing"));
  EXPECT_THAT(
      message([](Scene&, auto& s) { std::swap(s.vesicle.band.node[0], s.vesicle.band.node[1]); }),
      HasSubstr("nodes out of order"));
  EXPECT_THAT(message([](Scene&, auto& s) { s.vesicle.band.node.back() = 24 * 24 * 24; }),
              HasSubstr("nodes out of order"));
  EXPECT_THAT(message([](Scene&, auto& s) { s.vesicle.band.x[7] = 1e300; }),
              HasSubstr("leaves the box"));
  EXPECT_THAT(message([](Scene&, auto& s) { s.vesicle.band.y.pop_back(); }), HasSubstr("the band"));
  EXPECT_THAT(message([](Scene&, auto& s) { s.stepper.rate.pop_back(); }), HasSubstr("a rate"));
  EXPECT_THAT(message([](Scene&, auto& s) { s.steps = 0; }), HasSubstr("no step"));
}

TEST_F(Checkpoints, AreRefusedWhenTruncatedOrDamaged) {
  store();
  const std::string whole = content_of(file());
  for (std::size_t size = 0; size < whole.size(); size += 50021)
    ASSERT_THAT(message_for(whole.substr(0, size)), HasSubstr("cannot be read as a checkpoint"));
  for (std::size_t n = 0; n < whole.size(); n += 50021) {
    std::string damaged = whole;
    damaged[n] = static_cast<char>(damaged[n] ^ (1 << (n % 8)));
    ASSERT_THAT(message_for(damaged), HasSubstr("damaged")) << n;
  }
  EXPECT_EQ(message_for(whole), "no StoreError");
}

TEST_F(Checkpoints, AreRefusedWhenTheyAreSomethingElse) {
  Simulation sim(one_phase());
  write_frame(file(), sim.frame());
  EXPECT_THAT(message_of([&] { read_checkpoint(file()); }),
              HasSubstr("it is a frame without a checkpoint"));
  write_h5(Place(file()), 100, [](hid_t) {});
  EXPECT_THAT(message_of([&] { read_checkpoint(file()); }), HasSubstr("no group lamella"));
  EXPECT_THAT(message_for([](hid_t group) { write_attribute(group, "format", std::array{1}); }),
              HasSubstr("it is of format 1, this program reads 5"));
  EXPECT_THAT(message_for([](hid_t) {}), HasSubstr("attribute format is missing"));
}

TEST_F(Checkpoints, AreRefusedBeforeAnythingIsAllocatedForHostileSizes) {
  const auto with_scene = [&](hid_t type, std::vector<hsize_t> size, bool compressed) {
    return message_for([&](hid_t group) {
      write_attribute(group, "format", std::array{5});
      owned(H5Gcreate2(group, "phi_steps", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
      const H5Handle space = owned(H5Screate_simple(int(size.size()), size.data(), nullptr));
      const H5Handle properties = creation(H5P_DATASET_CREATE);
      const hsize_t chunk = 1024;
      if (compressed) {
        H5Pset_chunk(properties, 1, &chunk);
        H5Pset_deflate(properties, 9);
      }
      owned(H5Dcreate2(group, "scene", type, space, H5P_DEFAULT, properties, H5P_DEFAULT));
    });
  };
  EXPECT_THAT(with_scene(H5T_STD_U8LE, {10}, false), HasSubstr("program is missing"));
  EXPECT_THAT(with_scene(H5T_STD_U8LE, {hsize_t(1) << 40}, false), HasSubstr("scene is larger"));
  EXPECT_THAT(with_scene(H5T_STD_U8LE, {hsize_t(1) << 40}, true), HasSubstr("scene is larger"));
  EXPECT_THAT(with_scene(H5T_STD_U8LE, {4, 4}, false), HasSubstr("scene is larger"));
  EXPECT_THAT(with_scene(H5T_IEEE_F64LE, {10}, false), HasSubstr("scene is of another type"));
  put(file(), "");
  fs::resize_file(file(), std::uintmax_t(1) << 35); // 32 GiB of nothing
  EXPECT_THAT(message_of([&] { read_checkpoint(file()); }), HasSubstr("it is not one"));
}

TEST_F(Checkpoints, LeaveTheOneBeforeAloneWhenTheDiskIsFull) {
  store();
  const std::string before = content_of(file());
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  const auto action = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{4096, old.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string message = message_of([&] { store(); });
  setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, action);
  EXPECT_THAT(message, HasSubstr("cannot be written: File too large"));
  EXPECT_EQ(content_of(file()), before);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}), 1);
}

} // namespace
} // namespace lamella
