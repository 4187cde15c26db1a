// What it costs to store frames and checkpoints; part of lamella_bench.
#include "dynamics/simulation.h"
#include "scene/builtin.h"
#include "store/checkpoint.h"

#include <benchmark/benchmark.h>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <unistd.h>

namespace lamella {
namespace {

namespace fs = std::filesystem;

/// A folder in the current one, on whose disk runs would be stored; gone afterwards.
class Folder {
public:
  Folder() : path_("store_bench_" + std::to_string(::getpid())) { fs::create_directory(path_); }
  ~Folder() { fs::remove_all(path_); }
  fs::path file(const char* name) const { return path_ / name; }

private:
  fs::path path_;
};

/// Wall-clock time, and that of the processor.
struct Cost {
  double wall = 0, cpu = 0;

  void add(auto&& work) {
    const auto begin = std::chrono::steady_clock::now();
    const std::clock_t cpu_begin = std::clock();
    work();
    cpu += double(std::clock() - cpu_begin) / CLOCKS_PER_SEC;
    wall += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
};

/// A run with so many frames and a checkpoint at its end; counters: what they cost in percent of
/// the steps, each in milliseconds, and their sizes in MB.
void stored_run(benchmark::State& state, const char* name, double end_time) {
  Scene scene = builtin_scene(name, std::vector<std::string>{"grid.nodes=64"});
  scene.end_time = end_time;
  constexpr int frames = 50;
  const Folder folder;
  const fs::path frame = folder.file("frame.hdf"), checkpoint = folder.file("checkpoint.hdf");
  for (auto _ : state) {
    Simulation sim(scene);
    Cost steps, framing, checkpointing;
    framing.add([&] { write_frame(frame, sim.frame()); });
    for (int i = 1; i < frames; i++) {
      const double goal = end_time * i / (frames - 1);
      while (sim.time() < goal) steps.add([&] { sim.step(goal); });
      framing.add([&] { write_frame(frame, sim.frame()); });
    }
    checkpointing.add([&] {
      Checkpoint c;
      c.state = sim.state();
      write_checkpoint(checkpoint, sim.frame(), std::move(c));
    });
    const double megabyte = 1e6;
    state.counters["overhead_%"] = 100 * (framing.wall + checkpointing.wall) / steps.wall;
    state.counters["overhead_cpu_%"] = 100 * (framing.cpu + checkpointing.cpu) / steps.cpu;
    state.counters["steps_s"] = steps.wall;
    state.counters["frame_ms"] = 1e3 * framing.wall / frames;
    state.counters["frame_cpu_ms"] = 1e3 * framing.cpu / frames;
    state.counters["checkpoint_ms"] = 1e3 * checkpointing.wall;
    state.counters["checkpoint_cpu_ms"] = 1e3 * checkpointing.cpu;
    state.counters["frame_MB"] = double(fs::file_size(frame)) / megabyte;
    state.counters["checkpoint_MB"] = double(fs::file_size(checkpoint)) / megabyte;
  }
}

void BM_StoreOnePhase(benchmark::State& state) { stored_run(state, "fig3_oblate", 1.6e-3); }
void BM_StoreTwoPhases(benchmark::State& state) { stored_run(state, "fig9", 1e-3); }
BENCHMARK(BM_StoreOnePhase)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK(BM_StoreTwoPhases)->Unit(benchmark::kMillisecond)->Iterations(1);

} // namespace
} // namespace lamella
