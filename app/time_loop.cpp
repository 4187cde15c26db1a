#include "time_loop.h"

#include "dynamics/stopping.h"
#include "error.h"
#include "interrupt.h"
#include "progress.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <new>

namespace lamella {

namespace {

using Clock = std::chrono::steady_clock;

/// Why the scene's rules end the run here, or nothing.
std::optional<std::string> reason_to_stop(Stopping& stopping, const Simulation& sim,
                                          Clock::time_point begin) {
  const auto changes = std::ranges::count_if(sim.events(), &Event::changes_topology);
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return stopping.reason(sim.measures(), int(changes), sim.ramping(), seconds);
}

} // namespace

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

Outcome advance(Simulation& sim, const Scene& scene, const std::function<void(bool)>& store) {
  const auto begin = Clock::now();
  const int last = scene.output.frames - 1;
  Stopping stopping(scene.stop);
  Progress progress(scene);
  progress.tell(sim.events());
  for (int next = 1; next <= last;) {
    if (interrupt_requested()) return {interrupted, ""};
    if (const auto reason = reason_to_stop(stopping, sim, begin)) return {success, *reason};
    const double goal = next == last ? scene.end_time : scene.end_time * next / last;
    try {
      sim.step(goal);
    } catch (const RunError& e) {
      return {run_stopped, e.what()};
    }
    const bool frame_is_due = goal - sim.time() <= 1e-12 * goal;
    store(frame_is_due);
    progress.tell(sim.events());
    progress.update(sim.measures(), sim.next_dt());
    if (frame_is_due) next++;
  }
  return {};
}

} // namespace lamella
