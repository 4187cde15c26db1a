#include "run_folder.h"

#include "error.h"
#include "scene/scene_toml.h"
#include "store/atomic_file.h"
#include "usage_error.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <regex>
#include <sstream>

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace lamella {

namespace fs = std::filesystem;

namespace {

constexpr const char* scene_file = "scene.toml";
constexpr const char* start_file = "start.hdf";
constexpr const char* history_file = "history.csv";
constexpr const char* events_file = "events.csv";
constexpr const char* summary_file = "summary.txt";
constexpr const char* status_file = "status.toml";
constexpr const char* checkpoints_folder = "checkpoints";
constexpr const char* frames_folder = "frames";
constexpr const char* surfaces_name = "surfaces";
constexpr const char* series_file = "frames.hdf.series";

// The names of what a run writes, as regular expressions.
constexpr const char* own_files =
    R"(start\.hdf|history\.csv|events\.csv|status\.toml|summary\.txt|figure\.png|energy\.png)";
constexpr const char* own_scene = R"(scene\.toml)";
constexpr const char* results = R"(summary\.txt|figure\.png|energy\.png)";
constexpr const char* frame_names = R"(frame_\d{4,}\.hdf)";
constexpr const char* own_frames = R"(frame_\d{4,}\.hdf|frames\.hdf\.series)";
constexpr const char* own_checkpoints = R"(checkpoint_\d{8,}\.hdf)";
constexpr const char* own_surfaces = R"((membrane|boundary)_\d{4,}\.vtp|(membrane|boundary)\.pvd)";
constexpr std::size_t checkpoints_kept = 2;

std::string frame_file(std::size_t number) { return fmt::format("frame_{:04}.hdf", number); }
std::string checkpoint_file(long steps) { return fmt::format("checkpoint_{:08}.hdf", steps); }

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

void erase_if(const fs::path& folder, const std::function<bool(const fs::path&)>& unwanted) {
  if (!fs::is_directory(folder)) return;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (unwanted(entry.path())) files.push_back(entry.path());
  for (const fs::path& file : files) fs::remove(file);
}

/// What a killed program left of writing files of these names.
void erase_unfinished(const fs::path& folder, const char* names) {
  const std::string unfinished = fmt::format(R"(\.({})\.\d+-\d+\.tmp)", names);
  erase_if(folder, [&](const fs::path& file) { return matches(file, unfinished.c_str()); });
}

void erase(const fs::path& folder, const char* names) {
  erase_if(folder, [&](const fs::path& file) { return matches(file, names); });
  erase_unfinished(folder, names);
}

/// The scene last: as long as it is there, the folder holds a run.
void erase_run(const fs::path& folder) {
  for (const auto& [name, own] :
       {std::pair{checkpoints_folder, own_checkpoints}, std::pair{frames_folder, own_frames},
        std::pair{surfaces_name, own_surfaces}}) {
    const fs::path inner = folder / name;
    erase(inner, own);
    if (fs::is_directory(inner) && fs::is_empty(inner)) fs::remove(inner);
  }
  erase(folder, own_files);
  erase(folder, own_scene);
}

/// Files of these names, by the number in them.
std::vector<fs::path> numbered_files(const fs::path& folder, const char* names) {
  std::vector<fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (matches(entry.path(), names)) files.push_back(entry.path());
  std::ranges::sort(files, {}, [](const fs::path& file) {
    return std::pair(file.native().size(), file.native()); // frame_10000 comes after frame_9999
  });
  return files;
}

/// Why the run in a folder cannot go on from a checkpoint; empty where it can.
std::string misfit(const fs::path& folder, const Checkpoint& checkpoint) {
  const auto is_short = [&](const char* file, long size) {
    return size <= 0 || fs::file_size(folder / file) < std::uintmax_t(size);
  };
  if (is_short(history_file, checkpoint.history_size)) return "history.csv is shorter than it was";
  if (is_short(events_file, checkpoint.events_size)) return "events.csv is shorter than it was";
  for (std::size_t i = 0; i < checkpoint.frame_times.size(); i++)
    if (!fs::is_regular_file(folder / frames_folder / frame_file(i)))
      return frame_file(i) + " is missing";
  return {};
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

FolderLock::FolderLock(const fs::path& folder)
    : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(descriptor_);
    throw UsageError(folder.string() + ": another lamella is writing to this folder");
  }
} // a file system without locks must do without

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

RunFolder::RunFolder(const fs::path& folder, const Scene& scene, const Simulation& start)
    : folder_(folder), event_count_(start.time() > 0 ? start.events().size() : 0) {
  Scene stored = scene;
  std::optional<Frame> state; // read before anything is removed: it may be in this very folder
  if (scene.shape.kind == ShapeKind::frame) {
    state = read_frame(scene.shape.file);
    stored.shape.file = start_file;
  }
  or_store_error(folder, "cannot be used as output folder", [&] {
    fs::create_directories(folder);
    lock_.emplace(folder);
    erase_run(folder);
    try {
      if (state) write_frame(folder / start_file, *state);
      write_text_atomically(folder / scene_file, to_toml(stored));
      open_tables(start, nullptr);
      write(RunStatus{});
    } catch (...) {
      erase_run(folder);
      throw;
    }
  });
}

RunFolder::RunFolder(const fs::path& folder, const Simulation& now, const Checkpoint* from)
    : folder_(folder), event_count_(from ? now.events().size() : 0) {
  or_store_error(folder, "the run in it cannot be resumed", [&] {
    lock_.emplace(folder);
    remove_unfinished_files(folder);
    erase(folder, results);
    erase(folder / surfaces_name, own_surfaces);
    const std::size_t frames = from ? from->frame_times.size() : 0;
    for (std::size_t i = 0; i < frames; i++)
      series_.push_back({frame_file(i), from->frame_times[i]});
    open_tables(now, from);
    for (const fs::path& file : stored_frames(folder))
      if (std::ranges::count(series_, file.filename().string(), &SeriesEntry::file) == 0)
        fs::remove(file);
    for (const fs::path& file : stored_checkpoints(folder))
      if (!from || file.filename() > checkpoint_file(from->state.steps)) fs::remove(file);
    if (from) write_series(folder / frames_folder / series_file, series_);
  });
}

void RunFolder::open_tables(const Simulation& now, const Checkpoint* from) {
  const fs::path history = folder_ / history_file, events = folder_ / events_file;
  fs::create_directories(folder_ / frames_folder);
  if (from) {
    history_.emplace(history, now.measures(), std::size_t(from->history_size));
    events_.emplace(events, Event{}, std::size_t(from->events_size));
  } else {
    history_.emplace(history, now.measures());
    events_.emplace(events);
  }
}

/// write(file) writes the frame.
template <class Write>
void RunFolder::store_frame(double time, Write write) {
  const fs::path frames = folder_ / frames_folder;
  const std::string name = frame_file(series_.size());
  series_.push_back({name, time});
  writing_.start([file = frames / name, write = std::move(write), series = series_]() mutable {
    write(file);
    write_series(file.parent_path() / series_file, series);
  });
}

void RunFolder::add_frame(Frame frame) {
  const double time = frame.time;
  store_frame(time, [frame = std::move(frame)](const fs::path& file) { write_frame(file, frame); });
}

void RunFolder::add_frame(Frame frame, Checkpoint checkpoint) {
  const double time = frame.time;
  note_in(checkpoint);
  store_frame(time, [frame = std::move(frame),
                     checkpoint = std::move(checkpoint)](const fs::path& file) mutable {
    write_checkpoint(file, frame, std::move(checkpoint));
  });
}

void RunFolder::add_new(std::span<const Event> all) {
  for (; event_count_ < all.size(); event_count_++) events_->add(all[event_count_]);
}

/// What else is stored.
void RunFolder::note_in(Checkpoint& checkpoint) const {
  checkpoint.scene = scene_text();
  checkpoint.history_size = long(history_->size());
  checkpoint.events_size = long(events_->size());
  for (const SeriesEntry& entry : series_) checkpoint.frame_times.push_back(entry.time);
}

void RunFolder::add_checkpoint(const Frame& frame, Checkpoint checkpoint) {
  writing_.wait();
  history_->synchronise();
  events_->synchronise();
  note_in(checkpoint);
  const fs::path inner = folder_ / checkpoints_folder;
  or_store_error(inner, "cannot be written", [&] {
    fs::create_directories(inner);
    const std::string name = checkpoint_file(checkpoint.state.steps);
    write_checkpoint(inner / name, frame, std::move(checkpoint));
    const std::vector<fs::path> files = stored_checkpoints(folder_);
    for (std::size_t i = 0; i + checkpoints_kept < files.size(); i++) fs::remove(files[i]);
  });
}

void RunFolder::write(RunStatus status) {
  writing_.wait();
  status.scene_hash = hash_of(scene_text());
  write_status(folder_ / status_file, status);
}

std::string RunFolder::scene_text() const {
  std::ifstream stream(folder_ / scene_file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

void RunFolder::write_summary(const std::string& text) {
  writing_.wait();
  write_text_atomically(folder_ / summary_file, text);
}

fs::path surfaces_folder(const fs::path& run) { return run / surfaces_name; }

void clear_surfaces(const fs::path& folder) {
  or_store_error(folder, "cannot be used as a folder", [&] {
    fs::create_directories(folder);
    erase(folder, own_surfaces);
  });
}

std::optional<fs::path> end_of_run(const fs::path& folder) {
  return or_store_error(folder, "cannot be read", [&]() -> std::optional<fs::path> {
    if (!holds_run(folder) || !fs::exists(folder / summary_file)) return {};
    const std::vector<fs::path> files = stored_frames(folder);
    if (files.empty()) return {};
    return files.back();
  });
}

void require_run(const fs::path& folder) {
  or_store_error(folder, "cannot be read", [&] {
    if (!fs::is_directory(folder)) throw UsageError(folder.string() + ": no such folder");
    if (!holds_run(folder)) throw UsageError(folder.string() + ": holds no run");
  });
}

bool can_be_resumed(const fs::path& folder) {
  return or_store_error(folder, "cannot be read",
                        [&] { return fs::is_regular_file(folder / scene_file); });
}

void remove_unfinished_files(const fs::path& folder) {
  or_store_error(folder, "cannot be cleaned up", [&] {
    erase_unfinished(folder, own_files);
    erase_unfinished(folder, own_scene);
    erase_unfinished(folder / frames_folder, own_frames);
    erase_unfinished(folder / checkpoints_folder, own_checkpoints);
    erase_unfinished(folder / surfaces_name, own_surfaces);
  });
}

std::vector<fs::path> stored_frames(const fs::path& folder) {
  return or_store_error(folder, "cannot be read",
                        [&] { return numbered_files(folder / frames_folder, frame_names); });
}

std::vector<fs::path> stored_checkpoints(const fs::path& folder) {
  return or_store_error(folder, "cannot be read", [&] {
    return numbered_files(folder / checkpoints_folder, own_checkpoints);
  });
}

std::optional<Checkpoint>
newest_checkpoint(const fs::path& folder, const std::function<void(const std::string&)>& complain) {
  std::vector<fs::path> files = stored_checkpoints(folder);
  for (; !files.empty(); files.pop_back()) {
    try {
      Checkpoint checkpoint = read_checkpoint(files.back());
      const std::string why =
          or_store_error(folder, "cannot be read", [&] { return misfit(folder, checkpoint); });
      if (why.empty()) return checkpoint;
      complain(fmt::format("{}: {}", files.back().string(), why));
    } catch (const StoreError& e) {
      complain(e.what());
    }
  }
  return {};
}

RunStatus status_of_run(const fs::path& folder) {
  return fs::exists(folder / status_file) ? read_status(folder / status_file) : RunStatus{};
}

} // namespace lamella
