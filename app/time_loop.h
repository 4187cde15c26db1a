#pragma once
#include "dynamics/simulation.h"
#include "summary.h"

#include <functional>

namespace lamella {

/// The simulation of a scene at its start. Throws SceneError where it cannot start.
Simulation start(const Scene& scene);

/// Takes a simulation to the end of its scene and shows progress and events. `store` is called
/// after every step, with whether a frame is due.
Outcome advance(Simulation& simulation, const Scene& scene,
                const std::function<void(bool frame_is_due)>& store);

} // namespace lamella
