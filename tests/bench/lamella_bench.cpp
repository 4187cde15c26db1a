// Cost of a step and of its parts. In one run, so that ratios hold on a noisy machine:
//   lamella_bench --benchmark_filter=Step     milliseconds a step, and steps in units of one FFTW
//   pair lamella_bench --benchmark_filter=Run      the whole Fig. 3 oblate run, with its errors
//   lamella_bench --benchmark_filter=Store    frames and checkpoints, their time and size
//   LAMELLA_KERNELS=avx2 lamella_bench ...    the same with other kernels
#include "dynamics/simulation.h"
#include "parallel.h"
#include "scene/builtin.h"

#include <benchmark/benchmark.h>
#include <chrono>
#include <fftw3.h>

namespace lamella {
namespace {

Scene scene_at(std::string_view name, int nodes) {
  return builtin_scene(name, std::vector{"grid.nodes=" + std::to_string(nodes)});
}
Scene oblate_at(int nodes) { return scene_at("fig3_oblate", nodes); }

double seconds_of(auto&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// One real-to-complex and one complex-to-real transform of the whole box on one thread, as FFTW
/// does them.
class FftwPair {
public:
  explicit FftwPair(int n)
      : real_(std::size_t(n) * n * n, 1.), complex_(std::size_t(n) * n * (n / 2 + 1)) {
    auto* modes = reinterpret_cast<fftw_complex*>(complex_.data());
    forward_ = fftw_plan_dft_r2c_3d(n, n, n, real_.data(), modes, FFTW_MEASURE);
    backward_ = fftw_plan_dft_c2r_3d(n, n, n, modes, real_.data(), FFTW_MEASURE);
  }
  ~FftwPair() {
    fftw_destroy_plan(forward_);
    fftw_destroy_plan(backward_);
  }
  FftwPair(const FftwPair&) = delete;
  void run() {
    fftw_execute(forward_);
    fftw_execute(backward_);
  }

private:
  Array<double> real_;
  Array<std::complex<double>> complex_;
  fftw_plan forward_, backward_;
};

void BM_FftwPair(benchmark::State& state) {
  FftwPair pair(int(state.range(0)));
  for (auto _ : state) pair.run();
}
BENCHMARK(BM_FftwPair)
    ->Arg(48)
    ->Arg(64)
    ->Arg(96)
    ->Arg(128)
    ->Unit(benchmark::kMillisecond)
    ->MinTime(0.3);

/// A step of a scene, once it is under way. Arguments: nodes, threads. fftw_pairs: the same in
/// units of a pair of transforms of the whole box on one thread.
void step_of(benchmark::State& state, const Scene& scene) {
  const int nodes = int(state.range(0));
  set_thread_count(int(state.range(1)));
  Simulation sim(scene);
  FftwPair pair(nodes);
  for (int i = 0; i < 30; i++) sim.step(1);
  double fft = 0, steps = 0;
  for (auto _ : state) {
    const double seconds = seconds_of([&] { sim.step(1); });
    state.SetIterationTime(seconds);
    steps += seconds;
    fft += seconds_of([&] { pair.run(); });
  }
  state.counters["fftw_pairs"] = steps / fft;
  set_thread_count(0);
}
void BM_Step(benchmark::State& state) { step_of(state, oblate_at(int(state.range(0)))); }
BENCHMARK(BM_Step)
    ->ArgsProduct({{48, 64, 96, 128}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime()
    ->Iterations(30);

/// The same with two phases: one domain, twelve of them, twelve and the local stretch.
void BM_StepOneDomain(benchmark::State& state) {
  step_of(state, scene_at("fig9", int(state.range(0))));
}
void BM_StepTwelveDomains(benchmark::State& state) {
  step_of(state, scene_at("fig13a", int(state.range(0))));
}
void BM_StepWithStretch(benchmark::State& state) {
  step_of(state, scene_at("fig13b", int(state.range(0))));
}
BENCHMARK(BM_StepOneDomain)
    ->ArgsProduct({{48, 64, 96}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime()
    ->Iterations(30);
BENCHMARK(BM_StepTwelveDomains)
    ->ArgsProduct({{64}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime()
    ->Iterations(30);
BENCHMARK(BM_StepWithStretch)
    ->ArgsProduct({{64}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime()
    ->Iterations(30);

/// The bulged cap of Fig. 9 to t = 0.021; counters: steps, and the total energy against that at
/// rest.
void BM_RunOneDomain(benchmark::State& state) {
  const Scene scene = scene_at("fig9", int(state.range(0)));
  set_thread_count(int(state.range(1)));
  for (auto _ : state) {
    Simulation sim(scene);
    double steps = 0;
    for (; sim.time() < scene.end_time; steps++) sim.step(scene.end_time);
    state.counters["steps"] = steps;
    state.counters["energy_error"] = sim.measures().energy / 125.5287 - 1;
  }
  set_thread_count(0);
}
BENCHMARK(BM_RunOneDomain)
    ->ArgsProduct({{48, 64, 80}, {2}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

/// The whole run to t = 1.6e-3; counters: steps and errors of int K_M^2, P and sigma at the end.
void BM_Run(benchmark::State& state) {
  const Scene scene = oblate_at(int(state.range(0)));
  set_thread_count(int(state.range(1)));
  for (auto _ : state) {
    Simulation sim(scene);
    double steps = 0;
    for (; sim.time() < scene.end_time; steps++) sim.step(scene.end_time);
    state.counters["steps"] = steps;
    state.counters["E_error"] = sim.measures().int_KM2 - 98.3035;
    state.counters["P_error"] = sim.measures().P + 106.147;
    state.counters["sigma_error"] = sim.measures().sigma + 16.8057;
  }
  set_thread_count(0);
}
BENCHMARK(BM_Run)
    ->ArgsProduct({{32, 48, 64, 96, 128}, {2}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

/// Order-4 jets, order-2 curvatures and nearest points, nanoseconds a point, one thread.
template <class F>
void per_point(benchmark::State& state, F&& work) {
  Simulation sim(oblate_at(64));
  const Frame frame = sim.frame();
  LevelSet phi(frame.grid);
  Fourier fourier(frame.grid);
  phi.fit(frame.phi, fourier);
  NarrowBand band(frame.grid, 4.2);
  band.update(phi);
  const std::size_t n = band.size();
  std::vector<double> out[8];
  for (auto& o : out) o.resize(n);
  const SurfaceArrays arrays{out[0].data(), out[1].data(), out[2].data(),
                             out[3].data(), out[4].data(), out[5].data(),
                             out[6].data(), out[7].data(), {}};
  for (auto _ : state) work(phi, band, arrays);
  state.counters["ns_per_point"] =
      benchmark::Counter(double(n) * 1e-9, benchmark::Counter::kIsIterationInvariantRate |
                                               benchmark::Counter::kInvert);
}
void BM_Jets(benchmark::State& state) {
  per_point(state, [](const LevelSet& phi, NarrowBand& band, const SurfaceArrays& out) {
    kernels().jets(phi.view(), band.size(), {band.points().x, band.points().y, band.points().z},
                   out);
  });
}
void BM_Curvatures(benchmark::State& state) {
  per_point(state, [](const LevelSet& phi, NarrowBand& band, const SurfaceArrays& out) {
    kernels().curvatures(phi.view(), band.size(),
                         {band.points().x, band.points().y, band.points().z}, out);
  });
}
void BM_NearestPoints(benchmark::State& state) {
  per_point(state, [](const LevelSet& phi, NarrowBand& band, const SurfaceArrays& out) {
    kernels().closest_points(phi.view(), band.size(), band.positions(), band.points(), 1, false,
                             out.phi);
  });
}
BENCHMARK(BM_Jets)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Curvatures)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_NearestPoints)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace lamella

BENCHMARK_MAIN();
