#include "fields/scene_start.h"

#include "error.h"
#include "fields/run_files.h"
#include "scene/builtin.h"
#include "scene/scene_toml.h"

#include <fmt/format.h>

#include <algorithm>

namespace lamella {
namespace {

namespace fs = std::filesystem;

bool is_builtin(const std::string& name) {
  return std::ranges::any_of(builtin_scenes(),
                             [&](const BuiltinScene& scene) { return scene.name == name; });
}

/// The path of a frame, or of the last one of a run; the name of a built-in scene as it is.
std::string find_frame(const fs::path& home, const std::string& name) {
  const fs::path file = home / name;
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) return find_run_files(file).frames.back().file;
  return is_builtin(name) && !fs::exists(file, ignored) ? name : fs::absolute(file).string();
}

Scene with_frames_found(Scene scene, const fs::path& home) {
  if (scene.shape.kind == ShapeKind::frame) scene.shape.file = find_frame(home, scene.shape.file);
  if (!scene.domains.file.empty()) scene.domains.file = find_frame(home, scene.domains.file);
  return scene;
}

} // namespace

Scene open_scene(const std::string& name, const std::vector<std::string>& overrides) {
  std::error_code ignored;
  const fs::path file = name;
  const bool builtin = !fs::exists(file, ignored) && !file.has_parent_path() &&
                       file.extension() != ".toml"; // what that is not, it says
  return with_frames_found(builtin ? builtin_scene(name, overrides) : read_scene(name, overrides),
                           file.parent_path());
}

Scene scene_of_text(const std::string& text, const std::vector<std::string>& overrides) {
  return with_frames_found(parse_scene(text, "scene", overrides), {});
}

Trajectory* SceneRun::begin(const Trajectory::GoOn& go_on) {
  if (!trajectory_) {
    const bool later = scene_.shape.kind == ShapeKind::frame && is_builtin(scene_.shape.file);
    const std::optional<Start> start = later ? end_of_earlier(go_on) : start_of(scene_);
    if (!start) return nullptr;
    trajectory_.emplace(scene_, *start);
    earlier_.reset();
  }
  return &*trajectory_;
}

std::optional<Start> SceneRun::end_of_earlier(const Trajectory::GoOn& go_on) {
  Scene earlier = builtin_scene(scene_.shape.file);
  earlier.nodes = scene_.nodes;
  earlier.half_width = scene_.half_width;
  earlier.output.frames = 2;
  if (!earlier_) {
    validate(earlier);
    earlier_ = std::make_unique<SceneRun>(earlier);
  }
  Trajectory* trajectory = earlier_->begin(go_on);
  if (!trajectory) return {};
  const State end = trajectory->at(earlier.end(), go_on);
  if (trajectory->interrupted()) return {};
  if (trajectory->failure())
    throw RunError(fmt::format("{}, where the scene starts, stopped at t = {:.6g}: {}",
                               earlier.name, trajectory->time(), *trajectory->failure()));
  return start_of(scene_, end.frame);
}

} // namespace lamella
