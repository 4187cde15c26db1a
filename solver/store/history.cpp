#include "store/history.h"

#include "error.h"
#include "store/atomic_file.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>
#include <variant>

#include <fcntl.h>

namespace lamella {
namespace {

struct Column {
  std::string_view name;
  std::variant<double Measures::*, int Measures::*> member;
};

constexpr std::array columns{
    Column{"t", &Measures::time},
    Column{"dt", &Measures::dt},
    Column{"energy", &Measures::energy},
    Column{"bending_energy", &Measures::bending_energy},
    Column{"int_KM2", &Measures::int_KM2},
    Column{"P", &Measures::P},
    Column{"sigma", &Measures::sigma},
    Column{"sigma_DA", &Measures::sigma_DA},
    Column{"A", &Measures::area},
    Column{"V", &Measures::volume},
    Column{"v", &Measures::reduced_volume},
    Column{"Da", &Measures::area_difference},
    Column{"dA_rel", &Measures::area_drift},
    Column{"dV_rel", &Measures::volume_drift},
    Column{"max_speed", &Measures::max_speed},
    Column{"components", &Measures::components},
    Column{"genus", &Measures::genus},
};

std::string header() {
  std::string line;
  for (const Column& column : columns)
    line += fmt::format("{}{}", line.empty() ? "" : ",", column.name);
  return line;
}

template <class T>
bool parse(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() && std::isfinite(double(value));
}

/// Cut the text before the next comma off a line. False at the end of the line.
bool next_field(std::string_view& line, std::string_view& field) {
  if (line.data() == nullptr) return false;
  const auto comma = line.find(',');
  field = line.substr(0, comma);
  line = comma == line.npos ? std::string_view() : line.substr(comma + 1);
  return true;
}

bool parse_row(std::string_view line, Measures& row) {
  std::string_view field;
  for (const Column& column : columns) {
    if (!next_field(line, field)) return false;
    if (!std::visit([&](auto member) { return parse(field, row.*member); }, column.member))
      return false;
  }
  return line.data() == nullptr;
}

std::string json_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += {'\\', c};
    else if (static_cast<unsigned char>(c) < 0x20)
      out += fmt::format("\\u{:04x}", c);
    else
      out += c;
  }
  return out + '"';
}

} // namespace

HistoryWriter::HistoryWriter(const std::filesystem::path& file)
    : path_(file), file_(file, O_CREAT | O_TRUNC | O_APPEND) {
  append(header());
}

void HistoryWriter::append(const std::string& line) {
  const std::string text = line + '\n';
  try {
    file_.write(std::as_bytes(std::span(text)));
  } catch (const StoreError&) {
    file_.truncate(size_);
    throw;
  }
  size_ += text.size();
}

void HistoryWriter::add(const Measures& measures) {
  std::string line;
  for (const Column& column : columns) {
    std::visit(
        [&](auto member) {
          const double value = measures.*member;
          if (!std::isfinite(value))
            throw StoreError(fmt::format("{}: row not written: {} is {} at t = {}", path_.string(),
                                         column.name, value, measures.time));
          line += fmt::format("{}{:.12g}", line.empty() ? "" : ",", value);
        },
        column.member);
  }
  append(line);
}

std::vector<Measures> read_history(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw_system_error(file, "read");
  std::vector<Measures> rows;
  std::size_t number = 0;
  for (std::string line; std::getline(stream, line);) {
    const bool is_cut = stream.eof(); // every line ends with a newline
    const auto refuse = [&](std::string_view why) {
      throw StoreError(fmt::format("{}:{}: not a history: {}", file.string(), number, why));
    };
    if (++number == 1) {
      if (line != header() || is_cut)
        refuse("the first line does not name the columns of a history");
      continue;
    }
    Measures row;
    if (is_cut || !parse_row(line, row))
      refuse(fmt::format("expected {} finite numbers between commas", columns.size()));
    rows.push_back(row);
  }
  if (number == 0) throw StoreError(fmt::format("{}: not a history: it is empty", file.string()));
  return rows;
}

void write_series(const std::filesystem::path& file, std::span<const SeriesEntry> entries) {
  std::string text = "{\n  \"file-series-version\": \"1.0\",\n  \"files\": [";
  std::string_view separator = "\n";
  for (const SeriesEntry& entry : entries) {
    if (!std::isfinite(entry.time))
      throw StoreError(fmt::format("{}: not written: the time of {} is {}", file.string(),
                                   entry.file, entry.time));
    text += fmt::format("{}    {{\"name\": {}, \"time\": {}}}", separator, json_text(entry.file),
                        entry.time);
    separator = ",\n";
  }
  write_text_atomically(file, text + "\n  ]\n}\n");
}

} // namespace lamella
