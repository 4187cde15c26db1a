#include "find_scene.h"

#include "error.h"
#include "nearest.h"
#include "regular_file.h"
#include "run_contents.h"
#include "scene/builtin.h"
#include "scene/keys.h"
#include "scene/scene_toml.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <optional>

namespace lamella {

namespace fs = std::filesystem;

namespace {

std::vector<std::string_view> builtin_names() {
  std::vector<std::string_view> names;
  for (const BuiltinScene& scene : builtin_scenes()) names.push_back(scene.name);
  return names;
}

bool is_builtin(const std::string& name) {
  return std::ranges::count(builtin_names(), std::string_view(name)) > 0;
}

bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

[[noreturn]] void refuse_folder(const fs::path& folder) {
  const fs::path inside = folder / "scene.toml";
  throw SceneError(
      fmt::format("{}: this is a folder, not a scene{}", folder.string(),
                  is_there(inside) ? "; the scene of the run in it is " + inside.string() : ""));
}

[[noreturn]] void refuse_missing_file(const fs::path& file) {
  const std::string stem = file.stem().string();
  if (!is_free(file))
    throw SceneError(file.string() + ": a symbolic link to something that is not there");
  throw SceneError(fmt::format("{}: no such file{}", file.string(),
                               is_builtin(stem) ? "; the built-in scene is called " + stem : ""));
}

[[noreturn]] void refuse_word(const std::string& word) {
  const std::string file = word + ".toml";
  std::string hint = is_there(file) ? fmt::format("; did you mean \"{}\"?", file)
                                    : suggestion(word, builtin_names());
  if (hint.empty()) hint = "; `lamella scenes` lists those";
  throw SceneError(fmt::format("\"{}\": neither a file nor a built-in scene{}", word, hint));
}

/// The scene as it is written.
Scene scene_of(const std::string& wanted, std::span<const std::string> overrides) {
  if (is_builtin(wanted)) return builtin_scene(wanted, overrides);
  const fs::path file = wanted;
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (error == std::errc::filename_too_long)
    throw SceneError(wanted.substr(0, 60) + "...: too long for the name of a file");
  if (fs::is_directory(status)) refuse_folder(file);
  if (status.type() != fs::file_type::not_found) return read_scene(file, overrides);
  if (file.has_parent_path() || file.extension() == ".toml" || !is_free(file))
    refuse_missing_file(file);
  refuse_word(wanted);
}

/// Where a relative path counts from that a scene gives for a key, such as shape.file.
fs::path home_of(const std::string& wanted, std::span<const std::string> overrides,
                 std::string_view key) {
  const bool is_set = std::ranges::any_of(
      overrides, [&](const std::string& text) { return text.starts_with(key); });
  return is_set || is_builtin(wanted) ? fs::path() : fs::path(wanted).parent_path();
}

[[noreturn]] void refuse_frame(const Scene& scene, const Key& key, const fs::path& file,
                               const std::string& what_is_missing) {
  throw SceneError(fmt::format(
      "{}: {} = {}: {}", scene.name, key.label(), value_text(key, scene),
      is_there(file) ? file.string() + " is neither a frame nor the folder of a run that has ended"
                     : what_is_missing));
}

/// The path of a frame, or of the last one of a run.
std::optional<std::string> find_frame(const fs::path& file) {
  std::error_code ignored;
  if (fs::is_regular_file(file, ignored)) return fs::absolute(file).string();
  if (const auto frame = end_of_run(file)) return fs::absolute(*frame).string();
  return {};
}

/// What shape.file is to be, see find_scene().
std::string find_start(const Scene& scene, const fs::path& home) {
  const fs::path file = home / scene.shape.file;
  if (const auto frame = find_frame(file)) return *frame;
  if (is_builtin(scene.shape.file)) return scene.shape.file;
  refuse_frame(scene, *find_key("shape", "file"), file,
               "no such frame, run or built-in scene" +
                   suggestion(scene.shape.file, builtin_names()));
}

/// The same for domains.file.
std::string find_phases(const Scene& scene, const fs::path& home) {
  const fs::path file = home / scene.domains.file;
  if (const auto frame = find_frame(file)) return *frame;
  refuse_frame(scene, *find_key("domains", "file"), file, "no such frame or run");
}

} // namespace

Scene find_scene(const std::string& wanted, std::span<const std::string> overrides) {
  Scene scene = scene_of(wanted, overrides);
  if (scene.shape.kind == ShapeKind::frame)
    scene.shape.file = find_start(scene, home_of(wanted, overrides, "shape.file"));
  if (scene.domains.kind == DomainsKind::frame && !scene.domains.file.empty())
    scene.domains.file = find_phases(scene, home_of(wanted, overrides, "domains.file"));
  return scene;
}

} // namespace lamella
