#pragma once
#include "dynamics/event.h"
#include "store/posix_file.h"

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace lamella {

/// One value of a row, and the column it stands in. The first column of a table is the time.
struct Field {
  std::string_view column;
  std::variant<double*, int*, Event::Kind*> value;
  std::string_view unit = {}; ///< in words, as in scene/keys.cpp: "energy/length²"
};
using Row = std::vector<Field>;

/// A file of comma-separated values: a line of column names, then rows, numbers with 12 significant
/// digits. Every row is in the file when add returns, so that a killed run keeps its rows.
class TableWriter {
public:
  /// Replaces the file. Throws StoreError, as add does.
  TableWriter(const std::filesystem::path& file, const Row& columns);
  /// Goes on after the first `size` bytes of a table that another writer left: the size() that it
  /// had. What follows them is cut off.
  TableWriter(const std::filesystem::path& file, const Row& columns, std::size_t size);

  /// Bytes.
  std::size_t size() const { return size_; }
  /// Makes the rows last through a power failure.
  void synchronise() { file_.synchronise(); }

  /// Refuses numbers that are not finite and rows of other columns. After a failure the file still
  /// ends with a whole row.
  void add(const Row& row);

private:
  void append(const std::string& line);

  std::filesystem::path path_;
  PosixFile file_;
  std::size_t columns_;
  std::size_t size_ = 0; ///< of the whole rows
};

/// The names in the first line of a table. Throws StoreError where the file cannot be read.
std::vector<std::string> read_columns(const std::filesystem::path& file);

/// Reads a table into rows that `add_row` supplies. Throws StoreError for anything but what a
/// TableWriter with the same columns wrote, with the line; `what` is the name of such a table.
void read_table(const std::filesystem::path& file, std::string_view what, const Row& columns,
                const std::function<Row()>& add_row);

} // namespace lamella
