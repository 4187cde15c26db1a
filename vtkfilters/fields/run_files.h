#pragma once
#include "store/history.h"

#include <filesystem>
#include <vector>

namespace lamella {

/// The folder of a run (`lamella run -o`), as far as it has come.
struct RunFiles {
  std::filesystem::path scene, history, events, components;
  std::vector<SeriesEntry> frames; ///< in the order of time, each with its whole path
};

/// The run that a path means: its folder, or a file in it. Throws StoreError where there is none.
RunFiles find_run_files(const std::filesystem::path& path);

} // namespace lamella
