#pragma once
#include "store/folder.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace lamella {

/// A folder for output that this process alone writes to while this lives. What is in it already is
/// to be looked at from then on, so that nothing comes in between.
class OutputFolder {
public:
  /// Makes the folder, and those around it, where there is none. Throws UsageError where another
  /// process writes to it, and StoreError.
  explicit OutputFolder(const std::filesystem::path& path);
  /// What it made goes again where nothing came into it.
  ~OutputFolder();
  OutputFolder(OutputFolder&&) = default;

  const Folder& operator*() const { return *folder_; }
  const Folder* operator->() const { return &*folder_; }

private:
  std::vector<std::filesystem::path> made_; ///< the outermost first
  std::optional<Folder> folder_;
};

/// Keeps the run in a folder from being replaced or resumed, for as long as a copy of this lives,
/// while files are made from it. Where a run is in progress there, it goes on.
[[nodiscard]] Folder hold_run(const std::filesystem::path& folder);

} // namespace lamella
