#include "run_contents.h"

#include "error.h"
#include "regular_file.h"
#include "run_names.h"
#include "store/frame.h"
#include "store/history.h"
#include "surface_collection.h"
#include "usage_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <regex>
#include <span>
#include <string_view>

namespace lamella {

namespace fs = std::filesystem;
namespace names = run_names;

namespace run_names {
std::string frame(std::size_t number) { return fmt::format("frame_{:04}.hdf", number); }
std::string checkpoint(long steps) { return fmt::format("checkpoint_{:08}.hdf", steps); }
} // namespace run_names

namespace {

constexpr std::array own_files{"figure.png",   "energy.png",  names::summary,
                               names::history, names::events, names::components,
                               names::scene,   names::start,  names::status};
constexpr std::array results{"figure.png", "energy.png", names::summary};

bool is_any_of(std::string_view name, std::span<const char* const> all) {
  return std::ranges::find(all, name) != all.end();
}

/// The number in the name of a frame, or of a checkpoint; nothing for other names.
std::optional<std::size_t> number_in(const std::string& name, const char* pattern) {
  std::smatch match;
  if (!std::regex_match(name, match, std::regex(pattern))) return {};
  return std::stoul(match[1]);
}
std::optional<std::size_t> frame_number(const std::string& name) {
  return number_in(name, R"(frame_(\d{4,9})\.hdf)");
}
std::optional<std::size_t> steps_in(const std::string& name) {
  return number_in(name, R"(checkpoint_(\d{8,18})\.hdf)");
}

/// What a program was about to write when it was killed.
bool is_unfinished(const std::string& name) {
  static const std::regex pattern(R"(\.(.+)\.\d+-\d+\.tmp)");
  static const std::regex surface(R"((membrane|boundary)(_\d{4,}\.vtp|\.pvd))");
  std::smatch match;
  if (!std::regex_match(name, match, pattern)) return false;
  const std::string file = match[1];
  return is_any_of(file, own_files) || file == names::series || frame_number(file) ||
         steps_in(file) || std::regex_match(file, surface);
}

bool is_status(const fs::path& file) {
  try {
    read_status(file);
    return true;
  } catch (const StoreError&) {
    return false;
  }
}

/// Also one without rows yet.
bool is_history(const fs::path& file) {
  try {
    const std::vector<std::string> columns = read_columns(file);
    Measures measures = measures_with(columns);
    return std::ranges::equal(columns, row_of(measures), {}, {}, &Field::column);
  } catch (const StoreError&) {
    return false;
  }
}

/// Whether a folder of a run has a file with a name of its kind.
bool has_any(const Folder& run, const char* inner,
             std::optional<std::size_t> (*number)(const std::string&)) {
  const std::optional<Folder> folder = run.find(inner);
  return folder && std::ranges::any_of(folder->names(), [&](const std::string& name) {
           return number(name).has_value();
         });
}

/// Of a run that was killed while it began or was replaced: all that it can have then are its first
/// status and its start. What has lost its scene since is none.
bool is_remnant(const Folder& folder) {
  const auto may_be_there = [](std::string_view name) {
    return name == names::status || name == names::start;
  };
  for (const char* name : own_files)
    if (!may_be_there(name) && folder.type_of(name) != fs::file_type::not_found) return false;
  return is_status(folder.path() / names::status) &&
         !has_any(folder, names::frames, frame_number) &&
         !has_any(folder, names::checkpoints, steps_in);
}

/// Whether a frame may have been written when the program was killed, before it was listed.
bool has_unlisted_frame(const fs::path& folder) {
  return status_of_run(folder, [](const std::string&) {}).state == RunStatus::State::running;
}

std::size_t listed_frames(const fs::path& folder) {
  const fs::path series = folder / names::frames / names::series;
  return is_free(series) ? 0 : read_series(series).size();
}

[[noreturn]] void refuse_as_foreign(const fs::path& file, std::string_view why) {
  throw StoreError(
      fmt::format("{}: {}; move it away, or choose another folder", file.string(), why));
}

void require_regular(const Folder& folder, const std::string& name) {
  switch (folder.type_of(name)) {
  case fs::file_type::not_found:
  case fs::file_type::regular:
    return;
  case fs::file_type::symlink:
    refuse_as_foreign(folder.path() / name, "is a symbolic link, where a file of the run's own "
                                            "should be");
  default:
    refuse_as_foreign(folder.path() / name, "is no file, where a file of the run's own should be");
  }
}

/// Of the files in a folder of a run, those that `is_own` says; with what was about to be one.
void erase_if(const Folder& run, const char* inner,
              const std::function<bool(const std::string&)>& is_own) {
  const std::optional<Folder> folder = run.find(inner);
  if (!folder) return;
  for (const std::string& name : folder->names())
    if (is_own(name) || is_unfinished(name)) folder->remove(name);
}

/// Throws StoreError where a checkpoint relies on something that is damaged.
void check_fit(const fs::path& folder, const Checkpoint& checkpoint) {
  read_marked(folder / names::history, checkpoint.history);
  read_marked(folder / names::events, checkpoint.events);
  read_marked(folder / names::components, checkpoint.components);
  for (std::size_t i = 0; i < checkpoint.frame_times.size(); i++) {
    const fs::path file = folder / names::frames / names::frame(i);
    if (read_frame(file).time != checkpoint.frame_times[i])
      throw StoreError(fmt::format("{}: it is damaged: it is of another time than the one that the "
                                   "run wrote",
                                   file.string()));
  }
}

} // namespace

bool holds_run(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_regular_file(folder / names::scene, ignored) &&
         (is_status(folder / names::status) || is_history(folder / names::history));
}

void require_run(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) throw UsageError(folder.string() + ": no such folder");
  if (!holds_run(folder)) throw UsageError(folder.string() + ": holds no run");
}

std::optional<fs::path> end_of_run(const fs::path& folder) {
  if (!holds_run(folder) || is_free(folder / names::summary)) return {};
  const std::vector<fs::path> files = stored_frames(folder);
  if (files.empty()) return {};
  return files.back();
}

std::vector<fs::path> stored_frames(const fs::path& folder) {
  std::vector<fs::path> files;
  for (std::size_t n = 0, count = listed_frames(folder); n < count; n++)
    files.push_back(folder / names::frames / names::frame(n));
  return files;
}

std::vector<std::string> checkpoints_in(const Folder& folder) {
  std::vector<std::string> all = folder.names();
  std::erase_if(all, [](const std::string& name) { return !steps_in(name); });
  std::ranges::sort(all, {}, steps_in);
  return all;
}

std::vector<fs::path> stored_checkpoints(const fs::path& folder) {
  std::vector<fs::path> files;
  const fs::path inner = folder / names::checkpoints;
  if (is_free(inner)) return files;
  for (const std::string& name : checkpoints_in(Folder(inner))) files.push_back(inner / name);
  return files;
}

RunStatus status_of_run(const fs::path& folder,
                        const std::function<void(const std::string&)>& complain) {
  if (is_free(folder / names::status)) return {};
  try {
    return read_status(folder / names::status);
  } catch (const StoreError& e) {
    complain(fmt::format("{}; the run is taken for one that was killed", e.what()));
    return {};
  }
}

Resumption find_checkpoint(const fs::path& folder) {
  Resumption found;
  std::vector<fs::path> files = stored_checkpoints(folder);
  for (; !files.empty() && !found.checkpoint; files.pop_back()) {
    try {
      Checkpoint checkpoint = read_checkpoint(files.back());
      check_fit(folder, checkpoint);
      found.checkpoint = std::move(checkpoint);
    } catch (const StoreError& e) {
      found.damage.emplace_back(e.what());
    }
  }
  return found;
}

void check_stored_files(const fs::path& folder) {
  read_history(folder / names::history);
  read_events(folder / names::events);
  read_components(folder / names::components);
  for (const fs::path& frame : stored_frames(folder)) read_frame(frame);
}

void refuse_unsuitable(const Folder& folder, bool force) {
  const std::vector<std::string> there = folder.names();
  if (std::ranges::all_of(there, is_unfinished)) return;
  const bool run = holds_run(folder.path());
  if ((run && force) || is_remnant(folder)) return refuse_foreign(folder);
  throw UsageError(fmt::format("{}: the folder {}; choose another with -o{}",
                               folder.path().string(),
                               run     ? "holds a run"
                               : force ? "holds something else than a run, which --force leaves "
                                         "alone"
                                       : "is not empty",
                               run ? ", or replace the run with --force" : ""));
}

void refuse_foreign(const Folder& folder, std::size_t frames) {
  for (const char* name : own_files) require_regular(folder, name);
  folder.refuse_read_only();
  for (const char* name : {names::frames, names::checkpoints, names::surfaces})
    if (const std::optional<Folder> inner = folder.find(name)) inner->refuse_read_only();
  if (const std::optional<Folder> inner = folder.find(names::frames)) {
    require_regular(*inner, names::series);
    const std::size_t known = std::max(frames, listed_frames(folder.path())) +
                              (has_unlisted_frame(folder.path()) ? 1 : 0);
    for (const std::string& name : inner->names()) {
      const std::optional<std::size_t> number = frame_number(name);
      if (number) require_regular(*inner, name);
      if (number && *number >= known)
        refuse_as_foreign(inner->path() / name,
                          fmt::format("is not among the frames that {} lists", names::series));
    }
  }
  if (const std::optional<Folder> inner = folder.find(names::checkpoints))
    for (const std::string& name : inner->names())
      if (steps_in(name)) require_regular(*inner, name);
}

void erase_unfinished(const Folder& folder) {
  for (const std::string& name : folder.names())
    if (is_unfinished(name)) folder.remove(name);
}

void erase_run(const Folder& folder) {
  erase_later(folder, 0, -1);
  erase_if(folder, names::frames, [](const std::string& name) { return name == names::series; });
  erase_results(folder);
  for (const char* inner : {names::frames, names::checkpoints, names::surfaces})
    folder.remove_if_empty(inner);
  for (const char* name : own_files)
    if (name != std::string_view(names::status)) folder.remove(name);
}

void erase_results(const Folder& folder) {
  erase_unfinished(folder);
  for (const char* name : results) folder.remove(name);
  if (const std::optional<Folder> surfaces = folder.find(names::surfaces))
    erase_surfaces(*surfaces);
}

void erase_later(const Folder& folder, std::size_t frames, long steps) {
  erase_if(folder, names::checkpoints, [&](const std::string& name) {
    const std::optional<std::size_t> number = steps_in(name);
    return number && long(*number) > steps;
  });
  erase_if(folder, names::frames, [&](const std::string& name) {
    const std::optional<std::size_t> number = frame_number(name);
    return number && *number >= frames;
  });
}

void erase_surfaces(const Folder& surfaces) {
  std::vector<std::string> files = exported_files(surfaces);
  std::ranges::reverse(files); // the lists after what they list
  for (const std::string& file : files) surfaces.remove(file);
  erase_unfinished(surfaces);
}

} // namespace lamella
