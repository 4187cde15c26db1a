#pragma once
#include "scene/scene.h"

#include <span>
#include <string>

namespace lamella {

/// The scene that a user means. What has a folder or ".toml" in it is a file; another word is first
/// looked for among the built-in scenes, then as a file. Throws SceneError, with what may have been
/// meant instead.
///
/// In a scene that starts from a stored frame, shape.file is then the absolute path of that frame -
/// the last one, where a run's folder was meant - or the name of a built-in scene that is to be run
/// for it, and domains.file, where given, the absolute path of a frame. Relative paths count from
/// the scene's file; those of --set, and those of built-in scenes, from the current folder.
Scene find_scene(const std::string& wanted, std::span<const std::string> overrides);

} // namespace lamella
