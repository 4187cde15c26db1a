#pragma once
#include "scene/scene.h"
#include "store/background.h"
#include "store/checkpoint.h"
#include "store/frame.h"
#include "store/history.h"
#include "store/run_status.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lamella {

/// Throws UsageError for a folder that may not receive a run: one that is not empty, and with
/// `force` one that holds something else than an earlier run. Throws StoreError for what is no
/// folder.
void refuse_unsuitable(const std::filesystem::path& folder, bool force);

/// Keeps other processes from writing to a run; ends with the process at the latest.
class FolderLock {
public:
  /// Throws UsageError where another process has it.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

private:
  int descriptor_;
};

/// What a run leaves behind, and how it is laid out:
///   scene.toml              the scene as run, complete
///   start.hdf               the state it starts from, where the scene takes a stored one
///   status.toml             what became of it, for programs
///   history.csv             one row a step
///   events.csv              one row an event
///   frames/frame_0000.hdf   stored states, frames/frames.hdf.series for ParaView
///   checkpoints/checkpoint_00000123.hdf   after so many steps, all it takes to go on; the last two
///   figure.png, energy.png  pictures
///   summary.txt             the outcome in words
///   surfaces/               the membrane of each frame, where it was exported
class RunFolder {
public:
  /// Creates the folder, or removes what an earlier run left there and nothing else. The history
  /// has the columns of `start`. Throws StoreError, and UsageError for a folder that another
  /// process writes to.
  RunFolder(const std::filesystem::path& folder, const Scene& scene, const Simulation& start);

  /// Goes on with the run that is there: from a checkpoint of it, or with null from its start. What
  /// came later is removed, as is what a killed program left behind.
  RunFolder(const std::filesystem::path& folder, const Simulation& now, const Checkpoint* from);

  void add(const Measures& measures) { history_->add(measures); }
  /// Writes it while the caller goes on. What fails is thrown by the next call that stores a frame,
  /// a checkpoint, the summary or the status.
  void add_frame(Frame frame);
  /// One that is a checkpoint too, for branches.
  void add_frame(Frame frame, Checkpoint checkpoint);
  /// Adds those of all events so far that are not there yet.
  void add_new(std::span<const Event> all);
  /// Stores a checkpoint, having noted in it what else is stored, and keeps the one before it.
  void add_checkpoint(const Frame& frame, Checkpoint checkpoint);
  void write_summary(const std::string& text);
  /// The hash of the scene is filled in.
  void write(RunStatus status);

  const std::filesystem::path& path() const { return folder_; }
  int frames() const { return int(series_.size()); }
  double last_frame_time() const { return series_.empty() ? -1 : series_.back().time; }
  /// scene.toml as it is there.
  std::string scene_text() const;

private:
  template <class Write>
  void store_frame(double time, Write write);
  void note_in(Checkpoint& checkpoint) const;
  void open_tables(const Simulation& now, const Checkpoint* from);

  std::filesystem::path folder_;
  std::optional<FolderLock> lock_;
  std::optional<HistoryWriter> history_;
  std::optional<EventWriter> events_;
  std::size_t event_count_ = 0;
  std::vector<SeriesEntry> series_;
  Background writing_; // the last member: all else is there until it is done
};

/// The last frame of a run that has ended, also early; nothing for any other folder. Throws
/// StoreError for one that cannot be read.
std::optional<std::filesystem::path> end_of_run(const std::filesystem::path& folder);

/// Where the surfaces of a run go that are asked for later; they are replaced with it.
std::filesystem::path surfaces_folder(const std::filesystem::path& run);

/// Makes a folder for surfaces and removes those of an earlier export. Throws StoreError.
void clear_surfaces(const std::filesystem::path& folder);

/// Throws UsageError for a folder that holds no run.
void require_run(const std::filesystem::path& folder);

/// Whether there is a run that can be resumed, perhaps only from its start. Throws StoreError.
bool can_be_resumed(const std::filesystem::path& folder);

/// Removes what a program that was killed was about to write; a folder that then is empty may
/// receive a run. Throws StoreError.
void remove_unfinished_files(const std::filesystem::path& folder);

/// The newest checkpoint that the run in a folder can go on from. `complain` is told about those
/// that are damaged or do not fit what else is stored.
std::optional<Checkpoint>
newest_checkpoint(const std::filesystem::path& folder,
                  const std::function<void(const std::string&)>& complain);

/// The frames and the checkpoints of a run, the oldest first. Throws StoreError.
std::vector<std::filesystem::path> stored_frames(const std::filesystem::path& folder);
std::vector<std::filesystem::path> stored_checkpoints(const std::filesystem::path& folder);

/// As status.toml says; of a run that has none, that it is running. Throws StoreError.
RunStatus status_of_run(const std::filesystem::path& folder);

} // namespace lamella
