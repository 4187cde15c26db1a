#include "scene/builtin.h"

#include "error.h"
#include "nearest.h"
#include "scene/scene_toml.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace lamella {

Scene builtin_scene(std::string_view name, std::span<const std::string> overrides) {
  std::vector<std::string_view> names;
  for (const BuiltinScene& scene : builtin_scenes()) {
    if (scene.name == name) return parse_scene(scene.text, fmt::format("{}.toml", name), overrides);
    names.push_back(scene.name);
  }
  throw SceneError(fmt::format("{}: no built-in scene has this name; allowed: {}{}", name,
                               fmt::join(names, ", "), suggestion(name, names)));
}

} // namespace lamella
