// What a picture costs: `render_bench`. One panel of 1200 x 900 pixels once its frame is there.
#include "render/still.h"

#include <benchmark/benchmark.h>

#include <cmath>

namespace lamella::render {
namespace {

/// A dumbbell, of one or of two phases.
Frame dumbbell(bool phases) {
  Frame frame{Grid::cube(64, 1), 0, {}};
  for (std::size_t n = 0; n < frame.grid.size(); ++n) {
    const auto [x, y, z] = frame.grid.position(n);
    frame.phi.push_back(std::hypot(x, y) - 0.3 - 0.4 * z * z + 1.6 * std::pow(z, 6));
    if (phases) frame.fields["psi"].push_back(z);
  }
  return frame;
}

void extract(benchmark::State& state) {
  const Frame frame = dumbbell(state.range(0) == 2);
  for (auto _ : state) benchmark::DoNotOptimize(extract_surface(frame));
}

void draw(benchmark::State& state) {
  Studio studio("auto");
  const Surface surface = extract_surface(dumbbell(state.range(0) == 2));
  const Still still({surface}, {});
  for (auto _ : state) benchmark::DoNotOptimize(still.draw(surface, studio, 1200, 900));
}

/// Both.
void panel(benchmark::State& state) {
  Studio studio("auto");
  const Frame frame = dumbbell(state.range(0) == 2);
  for (auto _ : state) {
    const Surface surface = extract_surface(frame);
    benchmark::DoNotOptimize(Still({surface}, {}).draw(surface, studio, 1200, 900));
  }
}

void with_phases(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("phases")->Arg(1)->Arg(2)->MeasureProcessCPUTime()->UseRealTime();
  benchmark->Unit(benchmark::kMillisecond);
}

BENCHMARK(extract)->Apply(with_phases);
BENCHMARK(draw)->Apply(with_phases);
BENCHMARK(panel)->Apply(with_phases);

} // namespace
} // namespace lamella::render

BENCHMARK_MAIN();
