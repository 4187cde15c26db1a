#pragma once
#include "dynamics/measures.h"
#include "store/posix_file.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace lamella {

/// history.csv: a line of column names, then one row per Measures with 12 significant digits. Every
/// row is in the file when add returns, so that a killed run keeps its rows.
class HistoryWriter {
public:
  /// Replaces the file. Throws StoreError, as add does.
  explicit HistoryWriter(const std::filesystem::path& file);

  /// Refuses measures that are not finite. After a failure the file still ends with a whole row.
  void add(const Measures& measures);

private:
  void append(const std::string& line);

  std::filesystem::path path_;
  PosixFile file_;
  std::size_t size_ = 0; ///< of the whole rows
};

/// Throws StoreError for anything but what HistoryWriter wrote, with the line.
std::vector<Measures> read_history(const std::filesystem::path& file);

/// A stored frame as ParaView lists it.
struct SeriesEntry {
  std::string file; ///< beside the series file
  double time = 0;
};

/// Write "frames.hdf.series": ParaView opens the frames it lists as one data set over time. Whole
/// or not at all. Throws StoreError.
void write_series(const std::filesystem::path& file, std::span<const SeriesEntry> entries);

} // namespace lamella
