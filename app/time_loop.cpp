#include "time_loop.h"

#include "cancellation.h"
#include "error.h"
#include "interrupt.h"
#include "progress.h"

#include <algorithm>
#include <fmt/format.h>
#include <new>

namespace lamella {

namespace {
using Clock = std::chrono::steady_clock;
constexpr double rounding = 1e-12; // of times, relative
} // namespace

Simulation start(const Scene& scene) {
  const Cancellation when(interrupt_requested);
  try {
    return Simulation(scene);
  } catch (const RunError& e) {
    throw SceneError(fmt::format("{}: the run cannot start: {}", scene.name, e.what()));
  } catch (const std::bad_alloc&) {
    throw SceneError(
        fmt::format("{}: not enough memory for its grid; choose fewer grid.nodes", scene.name));
  }
}

TimeLoop::TimeLoop(Simulation& simulation, const Scene& scene, const Resumed& resumed)
    : simulation_(simulation), scene_(scene), stopping_(scene.stop, resumed.stopping),
      seconds_before_(resumed.wall_seconds), begin_(Clock::now()) {}

double TimeLoop::wall_seconds() const {
  return seconds_before_ + std::chrono::duration<double>(Clock::now() - begin_).count();
}

/// Why the scene's rules end the run here, or nothing.
std::optional<std::string> TimeLoop::reason_to_stop() {
  const auto changes = std::ranges::count_if(simulation_.events(), &Event::changes_topology);
  return stopping_.reason(simulation_.measures(), int(changes), simulation_.ramping(),
                          wall_seconds());
}

double TimeLoop::frame_time(int number) const {
  const int last = scene_.output.frames - 1;
  return number == last ? scene_.end() : scene_.end() * number / last;
}

Outcome TimeLoop::run(const std::function<void(bool)>& store) {
  const int last = scene_.output.frames - 1;
  Progress progress(scene_, simulation_.time());
  progress.tell(simulation_.events());
  const auto is_reached = [&](double goal) { return goal - simulation_.time() <= rounding * goal; };
  int next = 1;
  while (next <= last && is_reached(frame_time(next))) next++;
  while (next <= last) {
    if (interrupt_requested()) return {resumable, ""};
    if (const auto reason = reason_to_stop()) return {success, *reason};
    const double goal = frame_time(next);
    try {
      simulation_.step(goal);
    } catch (const RunError& e) {
      return {run_stopped, e.what()};
    }
    const bool frame_is_due = is_reached(goal);
    store(frame_is_due);
    progress.tell(simulation_.events());
    progress.update(simulation_.measures(), simulation_.next_dt());
    if (frame_is_due) next++;
  }
  return {};
}

} // namespace lamella
