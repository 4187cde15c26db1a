#pragma once
#include "scene/scene.h"

#include <span>
#include <string_view>

namespace lamella {

/// A balance of speed and accuracy, in terms of a scene's own grid and tolerance.
/// docs/tradeoff.md has what each costs and how accurate it is.
struct Preset {
  std::string_view name;
  double nodes = 1;     ///< factor of grid.nodes
  double tolerance = 1; ///< factor of numerics.tolerance
};

/// draft, standard (the scene as it is) and fine.
std::span<const Preset> presets();

/// Throws SceneError for an unknown name, with the nearest known one.
const Preset& find_preset(std::string_view name);

/// The scene with about `factor` times as many nodes: each axis the nearest multiple of 8, so that
/// the box keeps its proportions as far as these allow.
Scene with_nodes_times(double factor, Scene scene);

/// The scene at a preset. Not validated: its grid may be beyond what is allowed.
Scene at_preset(const Preset& preset, Scene scene);

} // namespace lamella
