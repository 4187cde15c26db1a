#include "commands.h"

#include "dynamics/simulation.h"
#include "error.h"
#include "find_scene.h"
#include "interrupt.h"
#include "parallel.h"
#include "progress.h"
#include "render/render.h"
#include "run_folder.h"
#include "scene/preset.h"
#include "summary.h"

#include <chrono>
#include <fmt/format.h>
#include <new>

namespace lamella {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

Simulation start(const Scene& scene) {
  try {
    return Simulation(scene);
  } catch (const RunError& e) {
    throw SceneError(fmt::format("{}: the run cannot start: {}", scene.name, e.what()));
  } catch (const std::bad_alloc&) {
    throw SceneError(
        fmt::format("{}: not enough memory for its grid; choose fewer grid.nodes", scene.name));
  }
}

/// Steps until the end time, storing as it goes.
Outcome advance(Simulation& sim, const Scene& scene, RunFolder& folder, Course& course) {
  const double longest =
      scene.numerics.max_time_step > 0 ? scene.numerics.max_time_step : scene.end_time / 16;
  const int last = scene.output.frames - 1;
  Progress progress(scene.end_time, longest);
  for (int next = 1; next <= last;) {
    if (interrupt_requested()) return {interrupted, ""};
    const double goal = next == last ? scene.end_time : scene.end_time * next / last;
    try {
      sim.step(goal);
    } catch (const RunError& e) {
      return {run_stopped, e.what()};
    }
    course.add(sim.measures());
    folder.add(sim.measures());
    progress.update(sim.measures(), sim.next_dt());
    if (goal - sim.time() > 1e-12 * goal) continue;
    folder.add(sim.frame());
    next++;
  }
  return {};
}

/// The whole run, with the state at which it ended as its last frame.
Outcome carry_out(Simulation& sim, const Scene& scene, RunFolder& folder, Course& course) {
  try {
    folder.add(sim.measures());
    folder.add(sim.frame());
    const Outcome outcome = advance(sim, scene, folder, course);
    if (folder.last_frame_time() < sim.time()) folder.add(sim.frame());
    return outcome;
  } catch (const StoreError& e) {
    throw StoreError(
        fmt::format("{}; the run stopped at t = {:.6g}, what was stored before is whole", e.what(),
                    sim.time()));
  }
}

int draw(const RunFolder& folder, const RunOptions& options) {
  try {
    draw_pictures({folder.path(), options.backend});
  } catch (const RenderError& e) {
    const std::string message = fmt::format(
        "lamella: no pictures: {}; all else is stored, `lamella render` draws it later\n",
        e.what());
    std::fputs(message.c_str(), stderr);
    return no_pictures;
  }
  return success;
}

/// Neither a full disk nor a reader that went away may end a run, so nothing is thrown.
void say(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

std::string opening(const Scene& scene) {
  const Grid grid = scene.grid();
  return fmt::format("{}: {} x {} x {} nodes, to t = {:g}, {} thread{}\n", scene.name, grid.nx(),
                     grid.ny(), grid.nz(), scene.end_time, thread_count(),
                     thread_count() == 1 ? "" : "s");
}

std::string result(const Course& course, double seconds) {
  return fmt::format("t = {:.6g} after {} steps in {}: energy {:.6g} -> {:.6g}; area and volume "
                     "kept within {:.0e}\n",
                     course.end().time, course.steps(), duration_text(seconds),
                     course.start().energy, course.end().energy,
                     std::max(course.area_drift(), course.volume_drift()));
}

std::string contents(const RunFolder& folder, bool pictures) {
  return fmt::format("In {}: {}summary.txt, history.csv, {} frames (for ParaView: "
                     "frames/frames.hdf.series)\n",
                     folder.path().string(), pictures ? "figure.png, energy.png, " : "",
                     folder.frames());
}

} // namespace

int run(const RunOptions& options) {
  const Scene scene =
      at_preset(find_preset(options.preset), find_scene(options.scene, options.set));
  validate(scene);
  const fs::path path = options.folder.empty() ? fs::path(scene.name) : options.folder;
  refuse_unsuitable(path, options.force);
  set_thread_count(options.threads);
  const auto begin = Clock::now();
  Simulation sim = start(scene);
  watch_for_interrupt();
  RunFolder folder(path, scene);
  say(opening(scene));

  Course course(sim.measures());
  const Outcome outcome = carry_out(sim, scene, folder, course);
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  folder.write_summary(summary(scene, course, outcome, seconds));
  say(result(course, seconds));
  if (outcome.code != success) {
    const std::string words = words_for(outcome, sim.time());
    std::fprintf(stderr, "lamella: the run %s; stored up to there\n", words.c_str());
  }
  const int pictures = options.no_pictures ? success : draw(folder, options);
  say(contents(folder, !options.no_pictures && pictures == success));
  return outcome.code != success ? outcome.code : pictures;
}

} // namespace lamella
