#pragma once
#include "output_folder.h"
#include "scene/scene.h"
#include "store/background.h"
#include "store/checkpoint.h"
#include "store/frame.h"
#include "store/history.h"
#include "store/run_status.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lamella {

/// What a run leaves behind, and how it is laid out:
///   scene.toml              the scene as run, complete
///   start.hdf               the state it starts from, where the scene takes a stored one
///   status.toml             what became of it, for programs
///   history.csv             one row a step
///   events.csv              one row an event
///   components.csv          one row a step and vesicle, of several that hold something of their
///   own frames/frame_0000.hdf   stored states, frames/frames.hdf.series for ParaView
///   checkpoints/checkpoint_00000123.hdf   after so many steps, all it takes to go on; the last two
///   figure.png, energy.png  pictures
///   summary.txt             the outcome in words
///   surfaces/               the membrane of each frame, where it was exported
class RunFolder {
public:
  /// A new run in a folder that may receive one, see refuse_unsuitable(); an earlier one is removed
  /// with `force`, and nothing else. The history has the columns of `start`. `origin`: of a branch.
  /// Throws UsageError, StoreError.
  RunFolder(OutputFolder folder, bool force, const Scene& scene, const Simulation& start,
            const std::string& origin = {});

  /// Goes on with the run that is there: from a checkpoint of it, or with null from its start. What
  /// came later is removed, as is what a killed program left behind. Throws StoreError.
  RunFolder(OutputFolder folder, const Simulation& now, const Checkpoint* from);

  void add(const Measures& measures) { history_->add(measures); }
  void add(std::span<const ComponentMeasures> vesicles);
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

  const std::filesystem::path& path() const { return folder_->path(); }
  int frames() const { return int(series_.size()); }
  double last_frame_time() const { return series_.empty() ? -1 : series_.back().time; }

private:
  template <class Write>
  void store_frame(double time, Write write);
  void note_in(Checkpoint& checkpoint) const;
  void open_tables(const Simulation& now, const Checkpoint* from);

  OutputFolder folder_;
  std::optional<Folder> frames_;
  std::string scene_text_; ///< scene.toml as the run has it
  std::optional<HistoryWriter> history_;
  std::optional<EventWriter> events_;
  std::optional<ComponentWriter> components_;
  std::size_t event_count_ = 0;
  std::vector<SeriesEntry> series_;
  Background writing_; // the last member: all else is there until it is done
};

} // namespace lamella
