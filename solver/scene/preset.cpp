#include "scene/preset.h"

#include "error.h"
#include "nearest.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <vector>

namespace lamella {

namespace {
constexpr std::array<Preset, 3> all{{{"draft", 0.75, 4}, {"standard"}, {"fine", 1.5, 0.25}}};
}

std::span<const Preset> presets() { return all; }

const Preset& find_preset(std::string_view name) {
  std::vector<std::string_view> names;
  for (const Preset& preset : all) {
    if (preset.name == name) return preset;
    names.push_back(preset.name);
  }
  throw SceneError(fmt::format("\"{}\": no such preset; allowed: {}{}", name,
                               fmt::join(names, ", "), suggestion(name, names)));
}

Scene with_nodes_times(double factor, Scene scene) {
  for (int& nodes : scene.nodes) nodes = 8 * int(std::lround(nodes * factor / 8));
  return scene;
}

Scene at_preset(const Preset& preset, Scene scene) {
  scene = with_nodes_times(preset.nodes, std::move(scene));
  scene.numerics.tolerance *= preset.tolerance;
  return scene;
}

} // namespace lamella
