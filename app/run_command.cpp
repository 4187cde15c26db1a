#include "commands.h"

#include "error.h"
#include "find_scene.h"
#include "interrupt.h"
#include "parallel.h"
#include "progress.h"
#include "run_folder.h"
#include "scene/preset.h"
#include "start_frame.h"
#include "summary.h"
#include "time_loop.h"

#include <chrono>
#include <fmt/format.h>

namespace lamella {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

/// One line on standard error.
void remark(const std::string& text) {
  std::fputs(fmt::format("lamella: {}\n", text).c_str(), stderr);
}

/// The whole run, with the state at which it ended as its last frame.
Outcome carry_out(Simulation& sim, const Scene& scene, RunFolder& folder, Course& course) {
  try {
    folder.add(sim.measures());
    folder.add_new(sim.events());
    folder.add(sim.frame());
    const Outcome outcome = advance(sim, scene, [&](bool frame_is_due) {
      course.add(sim.measures());
      folder.add(sim.measures());
      folder.add_new(sim.events());
      if (frame_is_due) folder.add(sim.frame());
    });
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
    draw_pictures({folder.path(), {.backend = options.backend}});
  } catch (const RenderError& e) {
    remark(fmt::format("no pictures: {}; all else is stored, `lamella render` draws it later",
                       e.what()));
    return no_pictures;
  }
  return success;
}

std::string opening(const Scene& scene, const std::string& origin) {
  const Grid grid = scene.grid();
  return fmt::format("{}: {} x {} x {} nodes, {}to t = {:g}, {} thread{}\n", scene.name, grid.nx(),
                     grid.ny(), grid.nz(), origin, scene.end_time, thread_count(),
                     thread_count() == 1 ? "" : "s");
}

std::string result(const Course& course, double seconds) {
  return fmt::format("t = {:.6g} after {} steps in {}: energy {:.6g} -> {:.6g}; constraints "
                     "kept within {:.0e}\n",
                     course.end().time, course.steps(), duration_text(seconds),
                     course.start().energy, course.end().energy,
                     std::max(course.area_drift(), course.volume_drift()));
}

/// What became of two phases.
std::string phases_result(const PhaseMeasures& start, const PhaseMeasures& end) {
  return fmt::format("bending Ld {:.6g} -> {:.6g}, Lo {:.6g} -> {:.6g}; line {:.6g} -> {:.6g}, "
                     "length {:.6g} -> {:.6g}; domains Ld {} -> {}, Lo {} -> {}\n",
                     start.bending_energy_Ld, end.bending_energy_Ld, start.bending_energy_Lo,
                     end.bending_energy_Lo, start.line_energy, end.line_energy, start.line_length,
                     end.line_length, start.domains_Ld, end.domains_Ld, start.domains_Lo,
                     end.domains_Lo);
}

void report(const Simulation& sim, const Course& course, const Outcome& outcome, double seconds) {
  const std::string words = words_for(outcome, sim.time()), warning = caution(sim.events());
  if (outcome.code == success && !outcome.reason.empty()) say(fmt::format("The run {}\n", words));
  say(result(course, seconds));
  if (course.end().phases) say(phases_result(*course.start().phases, *course.end().phases));
  if (outcome.code != success) remark(fmt::format("the run {}; stored up to there", words));
  if (!warning.empty()) remark("warning: " + warning);
}

std::string contents(const RunFolder& folder, bool pictures) {
  return fmt::format("In {}: {}summary.txt, history.csv, events.csv, {} frames (for ParaView: "
                     "frames/frames.hdf.series)\n",
                     folder.path().string(), pictures ? "figure.png, energy.png, " : "",
                     folder.frames());
}

} // namespace

int run(const RunOptions& options) {
  Scene scene = at_preset(find_preset(options.preset), find_scene(options.scene, options.set));
  validate(scene);
  const fs::path path = options.folder.empty() ? fs::path(scene.name) : options.folder;
  refuse_unsuitable(path, options.force);
  set_thread_count(options.threads);
  watch_for_interrupt();
  const std::string origin =
      scene.shape.kind == ShapeKind::frame ? fmt::format("from {} ", scene.shape.file) : "";
  const StartFrame start_frame(scene);
  const auto begin = Clock::now();
  Simulation sim = start(scene);
  if (interrupt_requested()) {
    remark("interrupted before the run began; nothing was written");
    return interrupted;
  }
  RunFolder folder(path, scene, sim.measures());
  say(opening(scene, origin));

  Course course(sim.measures());
  const Outcome outcome = carry_out(sim, scene, folder, course);
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  folder.write_summary(summary(scene, course, sim.events(), outcome, seconds));
  report(sim, course, outcome, seconds);
  const int pictures = options.no_pictures ? success : draw(folder, options);
  say(contents(folder, !options.no_pictures && pictures == success));
  return outcome.code != success ? outcome.code : pictures;
}

} // namespace lamella
