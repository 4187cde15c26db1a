#include "tradeoff/sweep.h"

#include "dynamics/simulation.h"
#include "dynamics/stopping.h"
#include "error.h"
#include "scene/preset.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>

namespace lamella {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double node_factors[]{0.5, 0.75, 1, 1.5};
constexpr double tolerance_factors[]{4, 1, 0.25};

std::vector<Scene> grids(const Scene& scene, const std::vector<int>& nodes) {
  const double shortest = std::ranges::min(scene.nodes);
  std::vector<Scene> scenes;
  for (const int n : nodes) scenes.push_back(with_nodes_times(n / shortest, scene));
  if (nodes.empty())
    for (const double factor : node_factors) scenes.push_back(with_nodes_times(factor, scene));
  return scenes;
}

std::vector<double> tolerances(const Scene& scene, const std::vector<double>& given) {
  if (!given.empty()) return given;
  std::vector<double> all;
  for (const double factor : tolerance_factors) all.push_back(factor * scene.numerics.tolerance);
  return all;
}

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Throws RunError, SceneError and what memory throws.
void advance(Trial& trial, const std::function<bool(double time)>& watch) {
  const auto begin = Clock::now();
  validate(trial.scene);
  Simulation sim(trial.scene);
  Stopping stopping(trial.scene.stop);
  const auto goes_on = [&] {
    const auto changes = std::ranges::count_if(sim.events(), &Event::changes_topology);
    return sim.time() < trial.scene.end() &&
           !stopping.reason(sim.measures(), int(changes), sim.ramping(), seconds_since(begin)) &&
           watch(sim.time());
  };
  trial.history.push_back(sim.measures());
  while (goes_on()) {
    sim.step(trial.scene.end());
    trial.history.push_back(sim.measures());
  }
}

} // namespace

std::vector<Scene> sweep(const Scene& scene, const SweepRange& range) {
  std::vector<Scene> scenes;
  if (range.presets_only)
    for (const Preset& preset : presets()) scenes.push_back(at_preset(preset, scene));
  else
    for (const Scene& grid : grids(scene, range.grids))
      for (const double tolerance : tolerances(scene, range.tolerances)) {
        scenes.push_back(grid);
        scenes.back().numerics.tolerance = tolerance;
      }
  std::ranges::stable_sort(scenes, {}, expected_cost);
  return scenes;
}

Scene finer_than_all(std::span<const Scene> scenes) {
  Scene finest =
      *std::ranges::max_element(scenes, {}, [](const Scene& scene) { return scene.grid().size(); });
  for (const Scene& scene : scenes)
    finest.numerics.tolerance = std::min(finest.numerics.tolerance, scene.numerics.tolerance);
  finest.numerics.tolerance /= 4;
  return with_nodes_times(4. / 3, finest);
}

// Steps grow with tolerance^-0.35, as measured on the oblate vesicle.
double expected_cost(const Scene& scene) {
  return double(scene.grid().size()) * std::pow(scene.numerics.tolerance, -0.35);
}

std::string_view preset_of(const Scene& variant, const Scene& scene) {
  for (const Preset& preset : presets()) {
    const Scene there = at_preset(preset, scene);
    if (there.nodes == variant.nodes && there.numerics.tolerance == variant.numerics.tolerance)
      return preset.name;
  }
  return {};
}

Trial run_trial(const Scene& scene, const std::function<bool(double time)>& watch) {
  Trial trial;
  trial.scene = scene;
  const auto begin = Clock::now();
  try {
    advance(trial, watch);
  } catch (const RunError& e) {
    trial.stopped = e.what();
  } catch (const SceneError& e) {
    trial.stopped = e.what();
  } catch (const std::bad_alloc&) {
    trial.stopped = "not enough memory";
  }
  trial.seconds = seconds_since(begin);
  return trial;
}

void mark_front(std::span<Trial> trials) {
  for (Trial& trial : trials) {
    const double error = trial.errors.largest();
    trial.on_front = !std::isnan(error) && std::ranges::none_of(trials, [&](const Trial& other) {
      return other.seconds < trial.seconds && other.errors.largest() < error;
    });
  }
}

} // namespace lamella
