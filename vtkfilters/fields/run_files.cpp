#include "fields/run_files.h"

#include "error.h"

#include <fmt/format.h>

#include <optional>

namespace lamella {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

/// The path itself or the nearest folder around it, up to that around frames/, which holds a run.
std::optional<fs::path> folder_around(const fs::path& path) {
  fs::path folder = fs::absolute(path).lexically_normal();
  for (int level = 0; level < 3; ++level, folder = folder.parent_path())
    if (is_file(folder / "scene.toml") && is_file(folder / "history.csv")) return folder;
  return {};
}

} // namespace

RunFiles find_run_files(const fs::path& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored))
    throw StoreError(fmt::format("{}: no such file or folder", path.string()));
  const std::optional<fs::path> folder = folder_around(path);
  if (!folder)
    throw StoreError(fmt::format("{}: neither the folder of a run nor in one; such a folder, as "
                                 "\"lamella run\" makes it, holds scene.toml and history.csv",
                                 path.string()));
  const fs::path series = *folder / "frames" / "frames.hdf.series";
  RunFiles run{*folder / "scene.toml", *folder / "history.csv", *folder / "events.csv",
               *folder / "components.csv", read_series(series)};
  for (SeriesEntry& frame : run.frames) frame.file = series.parent_path() / frame.file;
  if (run.frames.empty())
    throw StoreError(fmt::format("{}: the run has no frames", folder->string()));
  return run;
}

} // namespace lamella
