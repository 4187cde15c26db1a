#include "store/history.h"

#include "error.h"
#include "regular_file.h"
#include "store/atomic_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <regex>
#include <utility>

namespace lamella {
namespace {

template <class Record>
std::vector<Record> read_records(const std::filesystem::path& file, std::string_view what,
                                 Record like) {
  std::vector<Record> records;
  read_table(file, what, row_of(like), [&] { return row_of(records.emplace_back(like)); });
  return records;
}

void append(Row& row, PhaseMeasures& m) {
  row.insert(row.end(), {{"bending_Ld", &m.bending_energy_Ld, "energy"},
                         {"bending_Lo", &m.bending_energy_Lo, "energy"},
                         {"line_energy", &m.line_energy, "energy"},
                         {"sigma_Ld", &m.sigma_Ld, "energy/length²"},
                         {"sigma_Lo", &m.sigma_Lo, "energy/length²"},
                         {"A_Ld", &m.area_Ld, "length²"},
                         {"A_Lo", &m.area_Lo, "length²"},
                         {"dA_Ld_rel", &m.area_Ld_drift},
                         {"line_length", &m.line_length, "length"},
                         {"line_radius", &m.line_radius, "length"},
                         {"max_line_speed", &m.max_line_speed, "length/time"},
                         {"domains_Ld", &m.domains_Ld},
                         {"domains_Lo", &m.domains_Lo}});
}

void append(Row& row, StretchMeasures& m) {
  row.insert(row.end(), {{"c_min", &m.least}, {"c_max", &m.greatest}});
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

namespace {
constexpr std::string_view other_term = "energy_of_"; // begins the column of one not built in
}

Measures measures_with(std::span<const std::string> columns) {
  const auto has = [&](std::string_view column) {
    return std::ranges::find(columns, column) != columns.end();
  };
  Measures measures;
  if (has("A_Ld")) measures.phases.emplace();
  if (has("c_min")) measures.stretch.emplace();
  for (const TermInfo& term : energy_term_table)
    if (has(term.column)) measures.terms[term.term].emplace();
  for (const std::string& column : columns)
    if (column.starts_with(other_term))
      if (const std::string name = column.substr(other_term.size()); is_term_name(name))
        measures.terms.others()[name] = 0;
  if (has("work")) measures.balance.emplace(); // earlier versions wrote neither of these
  if (has("energy_rise")) measures.energy_rise.emplace();
  return measures;
}

Row row_of(Measures& m) {
  Row row{{"t", &m.time, "time"},
          {"dt", &m.dt, "time"},
          {"energy", &m.energy, "energy"},
          {info(Term::bending).column, &*m.terms[Term::bending], "energy"},
          {"int_KM2", &m.int_KM2},
          {"P", &m.P, "energy/length³"},
          {"sigma", &m.sigma, "energy/length²"},
          {"K_multiplier", &m.K_multiplier, "energy/length"},
          {"A", &m.area, "length²"},
          {"V", &m.volume, "length³"},
          {"v", &m.reduced_volume},
          {"Da", &m.area_difference},
          {"dA_rel", &m.area_drift},
          {"dV_rel", &m.volume_drift},
          {"max_speed", &m.max_speed, "length/time"},
          {"components", &m.components},
          {"genus", &m.genus}};
  if (m.phases) append(row, *m.phases);
  if (m.stretch) append(row, *m.stretch);
  for (const TermInfo& term : energy_term_table)
    if (auto& value = m.terms[term.term]; value && term.term != Term::bending)
      row.push_back({term.column, &*value, "energy"});
  for (auto& [name, energy] : m.terms.others())
    row.push_back({std::string(other_term) + name, &energy, "energy"});
  if (m.balance) {
    row.push_back({"work", &m.balance->work, "energy"});
    row.push_back({"dissipated", &m.balance->dissipated, "energy"});
  }
  if (m.energy_rise) row.push_back({"energy_rise", &*m.energy_rise});
  return row;
}

Row row_of(Event& e) {
  return {{"t", &e.time, "time"},
          {"kind", &e.kind},
          {"x", &e.place[0], "length"},
          {"y", &e.place[1], "length"},
          {"z", &e.place[2], "length"},
          {"size", &e.size, "length"},
          {"components_before", &e.components_before},
          {"components_after", &e.components_after},
          {"genus_before", &e.genus_before},
          {"genus_after", &e.genus_after},
          {"domains_before", &e.domains_before},
          {"domains_after", &e.domains_after},
          {"A_before", &e.area_before, "length²"},
          {"A_cut", &e.area_cut, "length²"},
          {"energy_before", &e.energy_before, "energy"},
          {"energy_after", &e.energy_after, "energy"},
          {"cells_x", &e.cells[0]},
          {"cells_y", &e.cells[1]},
          {"cells_z", &e.cells[2]}};
}

Row row_of(ComponentMeasures& m) {
  Row row{{"t", &m.time, "time"},
          {"component", &m.component},
          {"x", &m.center[0], "length"},
          {"y", &m.center[1], "length"},
          {"z", &m.center[2], "length"},
          {"V", &m.volume, "length³"},
          {"A", &m.area, "length²"},
          {"v", &m.reduced_volume},
          {"int_KM", &m.int_KM, "length"},
          {"P", &m.P, "energy/length³"},
          {"sigma", &m.sigma, "energy/length²"},
          {"K_multiplier", &m.K_multiplier, "energy/length"}};
  if (m.area_Ld) row.push_back({"A_Ld", &*m.area_Ld, "length²"});
  return row;
}

std::optional<double> value_of(Measures measures, std::string_view column) {
  for (const Field& field : row_of(measures)) {
    if (field.column != column) continue;
    if (auto* const* number = std::get_if<double*>(&field.value)) return **number;
    if (auto* const* count = std::get_if<int*>(&field.value)) return **count;
  }
  return {};
}

std::vector<Measures> read_history(const std::filesystem::path& file) {
  return read_records(file, "history", measures_with(read_columns(file)));
}

std::vector<Event> read_events(const std::filesystem::path& file) {
  return read_records(file, "table of events", Event{});
}

std::vector<ComponentMeasures> read_components(const std::filesystem::path& file) {
  if (is_free(file)) return {}; // of earlier versions
  ComponentMeasures like;
  const std::vector<std::string> columns = read_columns(file);
  if (std::ranges::count(columns, "A_Ld") > 0) like.area_Ld = 0;
  return read_records(file, "table of vesicles", like);
}

void write_series(const Place& place, std::span<const SeriesEntry> entries) {
  std::string text = "{\n  \"file-series-version\": \"1.0\",\n  \"files\": [";
  std::string_view separator = "\n";
  for (const SeriesEntry& entry : entries) {
    if (!std::isfinite(entry.time))
      throw StoreError(fmt::format("{}: not written: the time of {} is {}", place.path().string(),
                                   entry.file, entry.time));
    text += fmt::format("{}    {{\"name\": {}, \"time\": {}}}", separator, json_text(entry.file),
                        entry.time);
    separator = ",\n";
  }
  write_text_atomically(place, text + "\n  ]\n}\n");
}

void write_series(const std::filesystem::path& file, std::span<const SeriesEntry> entries) {
  write_series(Place(file), entries);
}

std::vector<SeriesEntry> read_series(const std::filesystem::path& file) {
  const std::string text = file_text(file);
  const std::regex entry(R"re(\{"name": "([^"\\]+)", "time": ([^}]+)\})re");
  std::vector<SeriesEntry> entries;
  for (std::sregex_iterator at(text.begin(), text.end(), entry), end; at != end; ++at) {
    const std::string number = (*at)[2];
    double time = 0;
    const auto [rest, error] = std::from_chars(number.data(), number.data() + number.size(), time);
    if (error != std::errc() || rest != number.data() + number.size())
      throw StoreError(fmt::format("{}: \"{}\" is not a time", file.string(), number));
    entries.push_back({(*at)[1], time});
  }
  return entries;
}

} // namespace lamella
