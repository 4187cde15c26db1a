#pragma once
#include "scene/scene.h"
#include "tradeoff/reference.h"

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lamella {

/// What to vary. An empty list stands for multiples of the scene's own value: 1/2, 3/4, 1 and 3/2
/// of its nodes, 4, 1 and 1/4 of its tolerance, the presets among them.
struct SweepRange {
  std::vector<int> grids; ///< nodes along the shortest axis
  std::vector<double> tolerances;
  bool presets_only = false;
};

/// All combinations, in the order of their expected cost.
std::vector<Scene> sweep(const Scene& scene, const SweepRange& range);

/// Beyond all of these: 4/3 of the nodes of the finest grid, 1/4 of the least tolerance.
Scene finer_than_all(std::span<const Scene> scenes);

/// Cost of a run in arbitrary units, to tell how long others will take.
double expected_cost(const Scene& scene);

/// The preset at which `scene` has the grid and the tolerance of `variant`, or nothing.
std::string_view preset_of(const Scene& variant, const Scene& scene);

/// A run that was timed.
struct Trial {
  Scene scene;
  std::string_view preset;       ///< or nothing
  std::vector<Measures> history; ///< the start and every step
  double seconds = 0;            ///< start and steps; nothing is stored or drawn
  Errors errors;
  std::string stopped; ///< why it did not reach its end; errors are then unknown
  bool on_front = false;

  std::size_t steps() const { return history.empty() ? 0 : history.size() - 1; }
};

/// Runs a scene. `watch` is told the time after every step and ends the run by returning false; the
/// trial then holds the steps so far.
Trial run_trial(const Scene& scene, const std::function<bool(double time)>& watch);

/// Marks the trials that no other one is both faster and more accurate than.
void mark_front(std::span<Trial> trials);

} // namespace lamella
