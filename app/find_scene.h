#pragma once
#include "scene/scene.h"

#include <span>
#include <string>

namespace lamella {

/// The scene that a user means. What has a folder or ".toml" in it is a file; another word is first
/// looked for among the built-in scenes, then as a file. Throws SceneError, with what may have been
/// meant instead.
Scene find_scene(const std::string& wanted, std::span<const std::string> overrides);

} // namespace lamella
