#pragma once
#include "fields/stored_frame.h"
#include "fields/trajectory.h"
#include "scene/scene.h"

#include <memory>
#include <string>
#include <vector>

namespace lamella {

/// The scene of a file, or the built-in one of that name where there is no such file, with
/// "section.key=value" overrides. Stored frames that it starts from are looked for from the file's
/// folder; their paths are then whole. Throws SceneError.
Scene open_scene(const std::string& name, const std::vector<std::string>& overrides);

/// The frame that such a scene starts from, if it is the end of a built-in scene: that runs first,
/// on the grid of this one. Sets shape.file. Null where there is nothing to do. Throws SceneError,
/// RunError.
std::unique_ptr<StoredFrame> run_start_of(Scene& scene, const Trajectory::GoOn& go_on);

} // namespace lamella
