#pragma once
#include "scene/scene.h"

#include <span>
#include <string>
#include <string_view>

namespace lamella {

/// A scene of data/scenes, compiled in.
struct BuiltinScene {
  std::string_view name;  ///< fig3_oblate
  std::string_view title; ///< one line
  std::string_view text;  ///< the whole file
};

/// All of them, sorted by name.
std::span<const BuiltinScene> builtin_scenes();

/// Parse one. Throws SceneError, for an unknown name with the nearest known one; messages about the
/// text name its file "fig3_oblate.toml".
Scene builtin_scene(std::string_view name, std::span<const std::string> overrides = {});

} // namespace lamella
