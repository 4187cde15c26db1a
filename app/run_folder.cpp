#include "run_folder.h"

#include "error.h"
#include "scene/scene_toml.h"
#include "store/atomic_file.h"

#include <algorithm>
#include <fmt/format.h>

namespace lamella {

namespace fs = std::filesystem;

namespace {

constexpr const char* scene_file = "scene.toml";
constexpr const char* history_file = "history.csv";
constexpr const char* summary_file = "summary.txt";
constexpr const char* frames_folder = "frames";
constexpr const char* series_file = "frames.hdf.series";

std::string frame_file(std::size_t number) { return fmt::format("frame_{:04}.hdf", number); }

/// `action` with the system's complaints turned into StoreError.
template <class F> auto or_store_error(const fs::path& path, const char* what, F&& action) {
  try {
    return action();
  } catch (const fs::filesystem_error& e) {
    throw StoreError(fmt::format("{}: {}: {}", path.string(), what, e.code().message()));
  }
}

void make_empty(const fs::path& folder, bool force) {
  if (fs::exists(folder) && !fs::is_directory(folder))
    throw StoreError(fmt::format("{}: exists and is not a folder; choose another with -o", folder.string()));
  fs::create_directories(folder);
  if (fs::is_empty(folder)) return;
  if (!force)
    throw StoreError(fmt::format("{}: the folder is not empty; choose another with -o, or replace the run in it with "
                                 "--force",
                                 folder.string()));
  for (const char* old : {scene_file, history_file, summary_file, frames_folder, "figure.png", "energy.png"})
    fs::remove_all(folder / old);
}

std::vector<fs::path> stored_frames(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder / frames_folder))
    if (entry.path().extension() == ".hdf") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

} // namespace

RunFolder::RunFolder(const fs::path& folder, const Scene& scene, bool force) : folder_(folder) {
  or_store_error(folder, "cannot use this folder", [&] {
    make_empty(folder, force);
    fs::create_directories(folder / frames_folder);
  });
  write_text_atomically(folder / scene_file, to_toml(scene));
  history_.emplace(folder / history_file);
}

void RunFolder::add(const Frame& frame) {
  const std::string name = frame_file(series_.size());
  write_frame(folder_ / frames_folder / name, frame);
  series_.push_back({name, frame.time});
  write_series(folder_ / frames_folder / series_file, series_);
}

void RunFolder::write_summary(const std::string& text) const { write_text_atomically(folder_ / summary_file, text); }

StoredRun read_run(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw StoreError(fmt::format("{}: no such folder", folder.string()));
  if (!fs::exists(folder / scene_file))
    throw StoreError(fmt::format("{}: not the folder of a run: it has no {}", folder.string(), scene_file));
  const std::vector<fs::path> files =
    or_store_error(folder, "cannot list its frames", [&] { return stored_frames(folder); });
  if (files.empty()) throw StoreError(fmt::format("{}: holds no frames", (folder / frames_folder).string()));
  return {read_scene(folder / scene_file), read_history(folder / history_file), read_frame(files.front()),
          read_frame(files.back())};
}

} // namespace lamella
