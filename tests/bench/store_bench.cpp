// What it costs to store frames and checkpoints; part of lamella_bench.
#include "dynamics/simulation.h"
#include "scene/builtin.h"
#include "store/background.h"
#include "store/checkpoint.h"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <chrono>
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

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

constexpr int frames = 50;

/// Wall-clock seconds of a run that ends its steps at the times of the frames, and stores them and
/// a checkpoint at its end where there is a folder.
double run(const Scene& scene, const Folder* folder) {
  Simulation sim(scene);
  Background writing;
  const auto store = [&] {
    if (folder)
      writing.start(
          [file = folder->file("frame.hdf"), frame = sim.frame()] { write_frame(file, frame); });
  };
  const auto begin = Clock::now();
  store();
  for (int i = 1; i < frames; i++) {
    const double goal = scene.end_time * i / (frames - 1);
    while (sim.time() < goal) sim.step(goal);
    store();
  }
  writing.wait();
  if (folder) {
    Checkpoint checkpoint;
    checkpoint.state = sim.state();
    write_checkpoint(folder->file("checkpoint.hdf"), sim.frame(), std::move(checkpoint));
  }
  return seconds_since(begin);
}

/// Counters: seconds of the run without storing, what storing adds in percent of them (both the
/// shortest of five in turn), and sizes in MB.
void stored_run(benchmark::State& state, const char* name) {
  const Scene scene = builtin_scene(name, std::vector<std::string>{"grid.nodes=64"});
  const Folder folder;
  constexpr double never = 1e9, megabyte = 1e6;
  for (auto _ : state) {
    double plain = never, stored = never;
    for (int i = 0; i < 5; i++) {
      plain = std::min(plain, run(scene, nullptr));
      stored = std::min(stored, run(scene, &folder));
    }
    state.counters["run_s"] = plain;
    state.counters["storing_%"] = 100 * (stored / plain - 1);
    state.counters["frame_MB"] = double(fs::file_size(folder.file("frame.hdf"))) / megabyte;
    state.counters["checkpoint_MB"] =
        double(fs::file_size(folder.file("checkpoint.hdf"))) / megabyte;
  }
}

/// A frame of fig3_oblate, from the state to the disk.
void store_frame(benchmark::State& state) {
  const Folder folder;
  const Simulation sim(builtin_scene("fig3_oblate", std::vector<std::string>{"grid.nodes=64"}));
  for (auto _ : state) write_frame(folder.file("frame.hdf"), sim.frame());
}

BENCHMARK(store_frame)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stored_run, fig3_oblate, "fig3_oblate")->Iterations(1);
BENCHMARK_CAPTURE(stored_run, fig7c_three, "fig7c_three")->Iterations(1);
BENCHMARK_CAPTURE(stored_run, fig8c, "fig8c")->Iterations(1);
BENCHMARK_CAPTURE(stored_run, fig9, "fig9")->Iterations(1);
BENCHMARK_CAPTURE(stored_run, fig15a, "fig15a")->Iterations(1);

} // namespace
} // namespace lamella
