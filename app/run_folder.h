#pragma once
#include "scene/scene.h"
#include "store/frame.h"
#include "store/history.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lamella {

/// Throws UsageError for a folder that may not receive a run: one that is not empty, and with
/// `force` one that holds something else than an earlier run. Throws StoreError for what is no
/// folder.
void refuse_unsuitable(const std::filesystem::path& folder, bool force);

/// What a run leaves behind, and how it is laid out:
///   scene.toml              the scene as run, complete
///   start.hdf               the state it starts from, where the scene takes a stored one
///   history.csv             one row a step
///   events.csv              one row an event
///   frames/frame_0000.hdf   stored states, frames/frames.hdf.series for ParaView
///   figure.png, energy.png  pictures
///   summary.txt             the outcome in words
class RunFolder {
public:
  /// Creates the folder, or removes what an earlier run left there and nothing else. The history
  /// has the columns of `start`. Throws StoreError.
  RunFolder(const std::filesystem::path& folder, const Scene& scene, const Measures& start);

  void add(const Measures& measures) { history_->add(measures); }
  void add(const Frame& frame);
  /// Adds those of all events so far that are not there yet.
  void add_new(std::span<const Event> all);
  void write_summary(const std::string& text) const;

  const std::filesystem::path& path() const { return folder_; }
  int frames() const { return int(series_.size()); }
  double last_frame_time() const { return series_.back().time; }

private:
  std::filesystem::path folder_;
  std::optional<HistoryWriter> history_;
  std::optional<EventWriter> events_;
  std::size_t event_count_ = 0;
  std::vector<SeriesEntry> series_;
};

/// The last frame of a run that has ended, also early; nothing for any other folder. Throws
/// StoreError for one that cannot be read.
std::optional<std::filesystem::path> end_of_run(const std::filesystem::path& folder);

} // namespace lamella
