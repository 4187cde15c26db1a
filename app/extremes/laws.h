#pragma once
#include "dynamics/event.h"
#include "dynamics/measures.h"
#include "scene/scene.h"

#include <functional>
#include <string>
#include <vector>

namespace lamella {

/// A law that every run obeys, whatever its scene, and how a run broke it.
struct BrokenLaw {
  std::string law; ///< "a larger box"
  std::string how; ///< for a person
};

/// A scene's run, as far as it was followed.
struct Trace {
  Scene scene;
  std::vector<Measures> history; ///< the start and after each step; empty where it could not start
  std::vector<Event> events;
  std::string message; ///< why it could not go on; empty where it could
};

/// A run of at most so many steps, not beyond a time.
Trace trace(const Scene& scene, long most_steps, double end_time);

/// What became of a scene and of its twins, which must go the same way.
struct LawReport {
  Trace run;
  std::vector<BrokenLaw> broken;
};

/// Runs a scene, and its twins in a larger box, in other units, with its axes renamed and on one
/// thread, and checks that
///
/// - all numbers are finite, and volume and areas are kept within 1e-3;
/// - the energy of an undriven run does not rise in a step by more than docs/extremes.md allows;
/// - in a box that is larger by 8 spacings on all sides nothing else happens: no event less, the
/// energy
///   the same to 1e-3 (two boxes take unequal steps);
/// - in units of length and energy that differ by powers of two the history is the same to 1e-8;
/// - with x, y, z renamed y, z, x the energy is the same to 1e-5;
/// - on one thread the history is the same to the last bit.
///
/// `go_on` is asked before each run.
LawReport check_laws(const Scene& scene, const std::function<bool()>& go_on);

} // namespace lamella
