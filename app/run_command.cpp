#include "commands.h"

#include "dynamics/simulation.h"
#include "error.h"
#include "exit_code.h"
#include "interrupt.h"
#include "kernels/kernels.h"
#include "parallel.h"
#include "progress.h"
#include "render/render.h"
#include "run_folder.h"
#include "scene/builtin.h"
#include "scene/scene_toml.h"

#include <chrono>
#include <fmt/format.h>

namespace lamella {

namespace {

using Clock = std::chrono::steady_clock;

Scene load(const RunOptions& options) {
  const std::filesystem::path path = options.scene;
  const bool is_file = path.extension() == ".toml" || path.has_parent_path() || std::filesystem::exists(path);
  return is_file ? read_scene(path, options.set) : builtin_scene(options.scene, options.set);
}

/// Why the time loop ended.
struct Outcome {
  int code = success;
  std::string words = "reached the end time";
};

std::string summary_of(const Scene& scene, const Simulation& sim, const Measures& start, const Outcome& outcome,
                       long steps, double seconds) {
  const Measures& m = sim.measures();
  const Grid& g = sim.grid();
  std::string text = fmt::format("{}\n{}\n\n", scene.title.empty() ? scene.name : scene.title,
                                 fmt::format("scene {}, {} x {} x {} nodes, spacing {:.5g}", scene.name, g.nx(),
                                             g.ny(), g.nz(), g.spacing));
  text += fmt::format("The run {} (t = {:.6g}, {} steps, {} on {} thread{}, {} kernels).\n\n", outcome.words, m.time,
                      steps, duration_text(seconds), thread_count(), thread_count() == 1 ? "" : "s", kernels().name);
  auto row = [&](const char* name, const char* symbol, double from, double to) {
    text += fmt::format("{:<22} {:<14} {:>14.8g} {:>14.8g}\n", name, symbol, from, to);
  };
  text += fmt::format("{:<22} {:<14} {:>14} {:>14}\n", "", "", "start", "end");
  row("energy", "E", start.energy, m.energy);
  row("", "int K_M^2 dA", start.int_KM2, m.int_KM2);
  row("pressure", "P", start.P, m.P);
  row("tension", "sigma", start.sigma, m.sigma);
  row("area", "A", start.area, m.area);
  row("volume", "V", start.volume, m.volume);
  row("reduced volume", "v", start.reduced_volume, m.reduced_volume);
  row("area difference", "Da", start.area_difference, m.area_difference);
  row("largest speed", "max |v_N|", start.max_speed, m.max_speed);
  row("components", "", start.components, m.components);
  row("genus", "", start.genus, m.genus);
  text += fmt::format("\nLargest drift: area {:.1e}, volume {:.1e}.\n", std::abs(m.area_drift), std::abs(m.volume_drift));
  return text;
}

/// Steps until the end time, storing as it goes.
Outcome advance(Simulation& sim, const Scene& scene, RunFolder& folder, long& steps) {
  const double longest = scene.numerics.max_time_step > 0 ? scene.numerics.max_time_step : scene.end_time / 16;
  Progress progress(scene.end_time, longest);
  Outcome outcome;
  for (int next = 1; next < scene.output.frames;) {
    const double goal = next + 1 == scene.output.frames ? scene.end_time
                                                        : scene.end_time * next / (scene.output.frames - 1);
    try {
      sim.step(goal);
    } catch (const RunError& e) {
      outcome = {run_stopped, fmt::format("stopped: {}", e.what())};
      break;
    }
    steps++;
    folder.add(sim.measures());
    progress.update(sim.measures(), sim.next_dt());
    if (sim.time() >= goal) {
      folder.add(sim.frame());
      next++;
    } else if (interrupt_requested()) {
      outcome = {interrupted, "was interrupted"};
      break;
    }
  }
  if (outcome.code != success) folder.add(sim.frame());
  return outcome;
}

int draw(const RunFolder& folder, const RunOptions& options) {
  try {
    const StoredRun run = read_run(folder.path());
    RenderOptions render_options;
    render_options.backend = options.backend;
    render_options.bending_modulus = run.scene.membrane.bending_modulus;
    render_run(run.start, run.end, run.history, folder.path(), render_options);
  } catch (const RenderError& e) {
    fmt::print(stderr, "lamella: no pictures: {}\n", e.what());
    return no_pictures;
  }
  return success;
}

} // namespace

int run(const RunOptions& options) {
  const Scene scene = load(options);
  set_thread_count(options.threads);
  const auto begin = Clock::now();
  Simulation sim(scene);
  const Measures start = sim.measures();
  RunFolder folder(options.folder.empty() ? std::filesystem::path(scene.name) : options.folder, scene, options.force);
  fmt::print("{}: {} x {} x {} nodes, to t = {:g}, {} thread{}\n", scene.name, sim.grid().nx(), sim.grid().ny(),
             sim.grid().nz(), scene.end_time, thread_count(), thread_count() == 1 ? "" : "s");
  std::fflush(stdout);
  watch_for_interrupt();
  folder.add(start);
  folder.add(sim.frame());
  long steps = 0;
  const Outcome outcome = advance(sim, scene, folder, steps);
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  const std::string summary = summary_of(scene, sim, start, outcome, steps, seconds);
  folder.write_summary(summary);
  const int pictures = options.no_pictures ? success : draw(folder, options);
  fmt::print("\n{}\n", summary);
  if (outcome.code != success) fmt::print(stderr, "lamella: the run {} at t = {:.6g}\n", outcome.words, sim.time());
  fmt::print("Pictures  {0}/figure.png, {0}/energy.png\nTable     {0}/history.csv\nFrames    {0}/frames ({1}; open "
             "frames.hdf.series in ParaView)\n",
             folder.path().string(), folder.frames());
  return outcome.code != success ? outcome.code : pictures;
}

} // namespace lamella
