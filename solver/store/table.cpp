#include "store/table.h"

#include "error.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <span>

#include <fcntl.h>

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

} // namespace

TableWriter::TableWriter(const std::filesystem::path& file, const Row& columns)
    : path_(file), file_(file, O_CREAT | O_TRUNC | O_APPEND), columns_(columns.size()) {
  append(header(columns));
}

TableWriter::TableWriter(const std::filesystem::path& file, const Row& columns, std::size_t size)
    : path_(file), file_(file, O_APPEND), columns_(columns.size()), size_(size) {
  const auto refuse = [&](std::string_view why) {
    throw StoreError(fmt::format("{}: the table cannot be continued: {}", file.string(), why));
  };
  if (std::filesystem::file_size(file) < size) refuse("rows are missing");
  std::ifstream stream(file, std::ios::binary);
  std::string line;
  if (!std::getline(stream, line) || line != header(columns)) refuse("it has other columns");
  stream.seekg(std::streamoff(size) - 1);
  if (stream.get() != '\n') refuse("its rows are not those that were there");
  if (!file_.truncate(size)) throw_system_error(file, "truncated");
}

void TableWriter::append(const std::string& line) {
  const std::string text = line + '\n';
  try {
    file_.write(std::as_bytes(std::span(text)));
  } catch (const StoreError&) {
    file_.truncate(size_);
    throw;
  }
  size_ += text.size();
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
  append(line);
}

std::vector<std::string> read_columns(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw_system_error(file, "read");
  std::string line;
  std::getline(stream, line);
  std::vector<std::string> columns;
  std::string_view rest = line, column;
  while (next_text(rest, column)) columns.emplace_back(column);
  return columns;
}

void read_table(const std::filesystem::path& file, std::string_view what, const Row& columns,
                const std::function<Row()>& add_row) {
  std::ifstream stream(file);
  if (!stream) throw_system_error(file, "read");
  std::size_t number = 0;
  for (std::string line; std::getline(stream, line);) {
    const bool is_cut = stream.eof(); // every line ends with a newline
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
