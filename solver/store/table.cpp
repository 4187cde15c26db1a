#include "store/table.h"

#include "error.h"
#include "regular_file.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <span>

namespace lamella {
namespace {

std::string header(const Row& columns) {
  std::string line;
  for (const Field& field : columns)
    line += fmt::format("{}{}", line.empty() ? "" : ",", field.column);
  return line;
}

template <class T>
std::string text_of(const T* number) {
  return fmt::format("{:.12g}", double(*number));
}

std::string text_of(const Event::Kind* kind) { return std::string(to_string(*kind)); }

template <class T>
bool is_finite(const T* number) {
  return std::isfinite(double(*number));
}

template <class T>
bool parse(std::string_view text, T* number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), *number);
  return error == std::errc{} && end == text.data() + text.size() && is_finite(number);
}

bool parse(std::string_view text, Event::Kind* kind) {
  const auto known = event_kind(text);
  if (known) *kind = *known;
  return known.has_value();
}

/// Cut the text before the next comma off a line. False at the end of the line.
bool next_text(std::string_view& line, std::string_view& text) {
  if (line.data() == nullptr) return false;
  const auto comma = line.find(',');
  text = line.substr(0, comma);
  line = comma == line.npos ? std::string_view() : line.substr(comma + 1);
  return true;
}

bool parse_row(std::string_view line, const Row& row) {
  std::string_view text;
  for (const Field& field : row) {
    if (!next_text(line, text)) return false;
    if (!std::visit([&](auto value) { return parse(text, value); }, field.value)) return false;
  }
  return line.data() == nullptr;
}

/// Of a table, when lines are added to it.
long checksum_after(long checksum, std::string_view lines) {
  while (!lines.empty()) {
    const std::string_view line = lines.substr(0, lines.find('\n') + 1);
    checksum = std::bit_cast<long>(
        XXH3_64bits_withSeed(line.data(), line.size(), std::bit_cast<XXH64_hash_t>(checksum)));
    lines.remove_prefix(line.size());
  }
  return checksum;
}

} // namespace

TableWriter::TableWriter(const std::filesystem::path& file, const Row& columns)
    : path_(file), file_(Place(file)), columns_(columns.size()) {
  append(header(columns) + '\n');
  file_.put_in_place();
}

TableWriter::TableWriter(const std::filesystem::path& file, const Row& columns,
                         const TableMark& mark)
    : path_(file), file_(Place(file)), columns_(columns.size()) {
  const std::string text = read_marked(file, mark);
  if (!text.starts_with(header(columns) + '\n'))
    throw StoreError(
        fmt::format("{}: the table cannot be continued: it has other columns", file.string()));
  append(text);
  file_.put_in_place();
}

/// Of whole lines.
void TableWriter::append(const std::string& lines) {
  try {
    file_.write(std::as_bytes(std::span(lines)));
  } catch (const StoreError&) {
    file_.truncate(std::size_t(mark_.size));
    throw;
  }
  mark_.size += long(lines.size());
  mark_.checksum = checksum_after(mark_.checksum, lines);
}

void TableWriter::add(const Row& row) {
  if (row.size() != columns_)
    throw StoreError(fmt::format("{}: row not written: it has {} values for {} columns",
                                 path_.string(), row.size(), columns_));
  std::string line;
  for (const Field& field : row) {
    const std::string text = std::visit([](auto value) { return text_of(value); }, field.value);
    if (const auto number = std::get_if<double*>(&field.value); number && !is_finite(*number))
      throw StoreError(fmt::format("{}: row not written: {} is {} at t = {}", path_.string(),
                                   field.column, text, *std::get<double*>(row.front().value)));
    line += fmt::format("{}{}", line.empty() ? "" : ",", text);
  }
  append(line + '\n');
}

std::string read_marked(const std::filesystem::path& file, const TableMark& mark) {
  const auto refuse = [&](std::string_view why) {
    throw StoreError(fmt::format("{}: it is damaged: {}", file.string(), why));
  };
  const std::string text = file_text(file, std::size_t(std::max(0L, mark.size)));
  if (long(text.size()) < mark.size || text.empty()) refuse("rows are missing");
  if (text.back() != '\n' || checksum_after(0, text) != mark.checksum)
    refuse("its rows are not those that were written");
  return text;
}

std::vector<std::string> read_columns(const std::filesystem::path& file) {
  constexpr std::size_t longest_line = 1 << 16;
  const std::string text = file_text(file, longest_line);
  std::string_view rest = std::string_view(text).substr(0, text.find('\n')), column;
  std::vector<std::string> columns;
  while (next_text(rest, column)) columns.emplace_back(column);
  return columns;
}

void read_table(const std::filesystem::path& file, std::string_view what, const Row& columns,
                const std::function<Row()>& add_row) {
  const std::string text = file_text(file);
  std::size_t number = 0;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t end = rest.find('\n');
    const bool is_cut = end == rest.npos; // every line ends with a newline
    const std::string_view line = rest.substr(0, end);
    rest = is_cut ? std::string_view() : rest.substr(end + 1);
    const auto refuse = [&](std::string_view why) {
      throw StoreError(fmt::format("{}:{}: not a {}: {}", file.string(), number, what, why));
    };
    if (++number == 1) {
      if (line != header(columns) || is_cut)
        refuse(fmt::format("the first line does not name the columns of a {}", what));
    } else if (is_cut || !parse_row(line, add_row())) {
      refuse(fmt::format("expected {} finite values between commas", columns.size()));
    }
  }
  if (number == 0) throw StoreError(fmt::format("{}: not a {}: it is empty", file.string(), what));
}

} // namespace lamella
