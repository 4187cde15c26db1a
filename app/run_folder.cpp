#include "run_folder.h"

#include "error.h"
#include "scene/scene_toml.h"
#include "store/atomic_file.h"
#include "usage_error.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <regex>

namespace lamella {

namespace fs = std::filesystem;

namespace {

constexpr const char* scene_file = "scene.toml";
constexpr const char* start_file = "start.hdf";
constexpr const char* history_file = "history.csv";
constexpr const char* events_file = "events.csv";
constexpr const char* summary_file = "summary.txt";
constexpr const char* frames_folder = "frames";
constexpr const char* series_file = "frames.hdf.series";

// The names of what a run writes, as regular expressions.
constexpr const char* own_files =
    R"(scene\.toml|start\.hdf|history\.csv|events\.csv|summary\.txt|figure\.png|energy\.png)";
constexpr const char* frame_names = R"(frame_\d{4,}\.hdf)";
constexpr const char* own_frames = R"(frame_\d{4,}\.hdf|frames\.hdf\.series)";

std::string frame_file(std::size_t number) { return fmt::format("frame_{:04}.hdf", number); }

bool matches(const fs::path& file, const char* names) {
  return std::regex_match(file.filename().string(), std::regex(names));
}

/// `action` with the system's complaints turned into StoreError.
template <class F>
auto or_store_error(const fs::path& path, const char* what, F&& action) {
  try {
    return action();
  } catch (const fs::filesystem_error& e) {
    throw StoreError(fmt::format("{}: {}: {}", path.string(), what, e.code().message()));
  }
}

/// A run has a scene and a history, which may have stayed empty.
bool holds_run(const fs::path& folder) {
  if (!fs::is_regular_file(folder / scene_file)) return false;
  std::ifstream history(folder / history_file);
  std::string columns;
  std::getline(history, columns);
  return fs::is_regular_file(folder / history_file) &&
         (columns.empty() || columns.starts_with("t,dt,energy,"));
}

/// Removes the files of these names, and what a killed program left of writing them.
void erase(const fs::path& folder, const char* names) {
  const std::string unfinished = fmt::format(R"(\.({})\.\d+-\d+\.tmp)", names);
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (matches(entry.path(), names) || matches(entry.path(), unfinished.c_str()))
      files.push_back(entry.path());
  for (const fs::path& file : files) fs::remove(file);
}

void erase_run(const fs::path& folder) {
  erase(folder, own_files);
  const fs::path frames = folder / frames_folder;
  if (!fs::is_directory(frames)) return;
  erase(frames, own_frames);
  if (fs::is_empty(frames)) fs::remove(frames);
}

/// In the order of time.
std::vector<fs::path> stored_frames(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder / frames_folder))
    if (matches(entry.path(), frame_names)) files.push_back(entry.path());
  std::ranges::sort(files, {}, [](const fs::path& file) {
    return std::pair(file.native().size(), file.native()); // frame_10000 comes after frame_9999
  });
  return files;
}

} // namespace

void refuse_unsuitable(const fs::path& folder, bool force) {
  or_store_error(folder, "cannot be used as output folder", [&] {
    if (!fs::exists(folder)) return;
    if (!fs::is_directory(folder))
      throw StoreError(
          fmt::format("{}: exists and is not a folder; choose another with -o", folder.string()));
    if (fs::is_empty(folder)) return;
    const bool run = holds_run(folder);
    if (run && force) return;
    throw UsageError(fmt::format("{}: the folder {}; choose another with -o{}", folder.string(),
                                 run ? "holds a run"
                                 : force
                                     ? "holds something else than a run, which --force leaves alone"
                                     : "is not empty",
                                 run ? ", or replace the run with --force" : ""));
  });
}

RunFolder::RunFolder(const fs::path& folder, const Scene& scene, const Measures& start)
    : folder_(folder) {
  Scene stored = scene;
  std::optional<Frame> state; // read before anything is removed: it may be in this very folder
  if (scene.shape.kind == ShapeKind::frame) {
    state = read_frame(scene.shape.file);
    stored.shape.file = start_file;
  }
  or_store_error(folder, "cannot be used as output folder", [&] {
    fs::create_directories(folder);
    erase_run(folder);
    try {
      write_text_atomically(folder / scene_file, to_toml(stored));
      if (state) write_frame(folder / start_file, *state);
      history_.emplace(folder / history_file, start);
      events_.emplace(folder / events_file);
      fs::create_directories(folder / frames_folder);
    } catch (...) {
      erase_run(folder);
      throw;
    }
  });
}

void RunFolder::add(const Frame& frame) {
  const std::string name = frame_file(series_.size());
  write_frame(folder_ / frames_folder / name, frame);
  series_.push_back({name, frame.time});
  write_series(folder_ / frames_folder / series_file, series_);
}

void RunFolder::add_new(std::span<const Event> all) {
  for (; event_count_ < all.size(); event_count_++) events_->add(all[event_count_]);
}

void RunFolder::write_summary(const std::string& text) const {
  write_text_atomically(folder_ / summary_file, text);
}

std::optional<fs::path> end_of_run(const fs::path& folder) {
  return or_store_error(folder, "cannot be read", [&]() -> std::optional<fs::path> {
    if (!holds_run(folder) || !fs::exists(folder / summary_file)) return {};
    const std::vector<fs::path> files = stored_frames(folder);
    if (files.empty()) return {};
    return files.back();
  });
}

} // namespace lamella
