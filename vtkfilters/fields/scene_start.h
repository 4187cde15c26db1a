#pragma once
#include "fields/trajectory.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace lamella {

/// The scene of a file, or the built-in one of that name where there is no such file, with
/// "section.key=value" overrides. Stored frames that it starts from are looked for from the file's
/// folder; their paths are then whole. Throws SceneError.
Scene open_scene(const std::string& name, const std::vector<std::string>& overrides);

/// The same for the text of a scene; frames are looked for from the current folder.
Scene scene_of_text(const std::string& text, const std::vector<std::string>& overrides);

/// What such a scene starts from. Where that is the end of a built-in scene, that runs first, on
/// the grid of this one. Throws SceneError, RunError, StoreError.
Start open_start(const Scene& scene, const Trajectory::GoOn& go_on);

} // namespace lamella
