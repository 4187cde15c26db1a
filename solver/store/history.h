#pragma once
#include "dynamics/event.h"
#include "dynamics/measures.h"
#include "store/table.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lamella {

/// The columns of history.csv and of events.csv, with the values of one row. Those of phases, of
/// stretch and of terms of the energy are there where the measures have them.
Row row_of(Measures& measures);
Row row_of(Event& event);
/// The columns of components.csv, likewise.
Row row_of(ComponentMeasures& measures);

/// Measures that have these columns.
Measures measures_with(std::span<const std::string> columns);

/// The value in a column of history.csv; nothing where the measures do not have it.
std::optional<double> value_of(Measures measures, std::string_view column);

/// A table that grows by records. Both functions throw StoreError, see TableWriter.
template <class Record>
class RecordWriter {
public:
  /// Replaces the file; for records with the same columns as `like`.
  explicit RecordWriter(const std::filesystem::path& file, Record like = {})
      : table_(file, row_of(like)) {}
  /// Goes on after the rows up to a mark.
  RecordWriter(const std::filesystem::path& file, Record like, const TableMark& mark)
      : table_(file, row_of(like), mark) {}
  const TableMark& mark() const { return table_.mark(); }
  void synchronise() { table_.synchronise(); }
  void add(Record record) { table_.add(row_of(record)); }

private:
  TableWriter table_;
};

using HistoryWriter = RecordWriter<Measures>; ///< history.csv: the start and every step
using EventWriter = RecordWriter<Event>;      ///< events.csv
/// components.csv: a row for each of several vesicles that hold something of their own, at the
/// start and after every step.
using ComponentWriter = RecordWriter<ComponentMeasures>;

/// Throw StoreError for anything but what these writers wrote, with the line.
std::vector<Measures> read_history(const std::filesystem::path& file);
std::vector<Event> read_events(const std::filesystem::path& file);
std::vector<ComponentMeasures> read_components(const std::filesystem::path& file);

/// A stored frame as ParaView lists it.
struct SeriesEntry {
  std::string file; ///< beside the series file
  double time = 0;
};

/// Write "frames.hdf.series": ParaView opens the frames it lists as one data set over time. Whole
/// or not at all. Throws StoreError.
void write_series(const Place& place, std::span<const SeriesEntry> entries);
void write_series(const std::filesystem::path& file, std::span<const SeriesEntry> entries);

/// What write_series wrote, as far as it is that. Throws StoreError for what cannot be read.
std::vector<SeriesEntry> read_series(const std::filesystem::path& file);

} // namespace lamella
