#pragma once
#include "fields/trajectory.h"
#include "scene/scene.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lamella {

/// The scene of a file, or the built-in one of that name where there is no such file, with
/// "section.key=value" overrides. Stored frames that it starts from are looked for from the file's
/// folder; their paths are then whole. Throws SceneError.
Scene open_scene(const std::string& name, const std::vector<std::string>& overrides);

/// The same for the text of a scene; frames are looked for from the current folder.
Scene scene_of_text(const std::string& text, const std::vector<std::string>& overrides);

/// Such a scene over time. Where it starts from the end of a built-in scene, that runs first, on
/// the grid of this one.
class SceneRun {
public:
  explicit SceneRun(const Scene& scene) : scene_(scene) {}

  /// The scene from its start on; nothing where `go_on` ended the way there, which the next call
  /// goes on with. Throws SceneError, RunError, StoreError.
  Trajectory* begin(const Trajectory::GoOn& go_on);

private:
  std::optional<Start> end_of_earlier(const Trajectory::GoOn& go_on);

  Scene scene_;
  std::unique_ptr<SceneRun> earlier_;
  std::optional<Trajectory> trajectory_;
};

} // namespace lamella
