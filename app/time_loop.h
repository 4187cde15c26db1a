#pragma once
#include "dynamics/simulation.h"
#include "dynamics/stopping.h"
#include "summary.h"

#include <chrono>
#include <functional>
#include <optional>
#include <string>

namespace lamella {

/// The simulation of a scene at its start. Throws SceneError where it cannot start, and Cancelled
/// where an interrupt is requested meanwhile.
Simulation start(const Scene& scene);

/// What a run brings along that it takes up again.
struct Resumed {
  Stopping::State stopping;
  double wall_seconds = 0; ///< that it has taken already
};

/// Takes a simulation to the end of its scene and shows progress and events.
class TimeLoop {
public:
  TimeLoop(Simulation& simulation, const Scene& scene, const Resumed& resumed = {});

  /// `store` is called after every step, with whether a frame is due.
  Outcome run(const std::function<void(bool frame_is_due)>& store);

  const Stopping::State& stopping() const { return stopping_.state(); }
  /// With those before it was resumed.
  double wall_seconds() const;

private:
  std::optional<std::string> reason_to_stop();
  double frame_time(int number) const;

  Simulation& simulation_;
  const Scene& scene_;
  Stopping stopping_;
  double seconds_before_;
  std::chrono::steady_clock::time_point begin_;
};

} // namespace lamella
