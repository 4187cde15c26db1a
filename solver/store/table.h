#pragma once
#include "dynamics/event.h"
#include "store/new_file.h"

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace lamella {

/// One value of a row, and the column it stands in. The first column of a table is the time.
struct Field {
  std::string column;
  std::variant<double*, int*, Event::Kind*> value;
  std::string_view unit = {}; ///< in words, as in scene/keys.cpp: "energy/length²"
};
using Row = std::vector<Field>;

/// How far a table has come: its bytes, and a checksum of them.
struct TableMark {
  long size = 0, checksum = 0;
  bool operator==(const TableMark&) const = default;
};

/// A file of comma-separated values: a line of column names, then rows, numbers with 12 significant
/// digits. Every row is in the file when add returns, so that a killed run keeps its rows.
class TableWriter {
public:
  /// A new file takes the place of one that is there. Throws StoreError, as add does.
  TableWriter(const std::filesystem::path& file, const Row& columns);
  /// Goes on, in a new file, after the rows of a table that another writer left: those up to the
  /// mark() that it had.
  TableWriter(const std::filesystem::path& file, const Row& columns, const TableMark& mark);

  const TableMark& mark() const { return mark_; }
  /// Makes the rows last through a power failure.
  void synchronise() { file_.synchronise(); }

  /// Refuses numbers that are not finite and rows of other columns. After a failure the file still
  /// ends with a whole row.
  void add(const Row& row);

private:
  void append(const std::string& line);

  std::filesystem::path path_;
  NewFile file_;
  std::size_t columns_;
  TableMark mark_; ///< after the last whole row
};

/// The text of a table up to a mark. Throws StoreError where it is not what was written.
std::string read_marked(const std::filesystem::path& file, const TableMark& mark);

/// The names in the first line of a table. Throws StoreError where the file cannot be read.
std::vector<std::string> read_columns(const std::filesystem::path& file);

/// Reads a table into rows that `add_row` supplies. Throws StoreError for anything but what a
/// TableWriter with the same columns wrote, with the line; `what` is the name of such a table.
void read_table(const std::filesystem::path& file, std::string_view what, const Row& columns,
                const std::function<Row()>& add_row);

} // namespace lamella
