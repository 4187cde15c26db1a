#include "store/history.h"

#include "error.h"
#include "store/atomic_file.h"

#include <fmt/format.h>

#include <cmath>

namespace lamella {
namespace {

template <class Record>
std::vector<Record> read_records(const std::filesystem::path& file, std::string_view what) {
  Record any;
  std::vector<Record> records;
  read_table(file, what, row_of(any), [&] { return row_of(records.emplace_back()); });
  return records;
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

Row row_of(Measures& m) {
  return {{"t", &m.time},
          {"dt", &m.dt},
          {"energy", &m.energy},
          {"bending_energy", &m.bending_energy},
          {"int_KM2", &m.int_KM2},
          {"P", &m.P},
          {"sigma", &m.sigma},
          {"K_multiplier", &m.K_multiplier},
          {"A", &m.area},
          {"V", &m.volume},
          {"v", &m.reduced_volume},
          {"Da", &m.area_difference},
          {"dA_rel", &m.area_drift},
          {"dV_rel", &m.volume_drift},
          {"max_speed", &m.max_speed},
          {"components", &m.components},
          {"genus", &m.genus}};
}

Row row_of(Event& e) {
  return {{"t", &e.time},
          {"kind", &e.kind},
          {"x", &e.place[0]},
          {"y", &e.place[1]},
          {"z", &e.place[2]},
          {"size", &e.size},
          {"components_before", &e.components_before},
          {"components_after", &e.components_after},
          {"genus_before", &e.genus_before},
          {"genus_after", &e.genus_after},
          {"A_before", &e.area_before},
          {"A_cut", &e.area_cut},
          {"energy_before", &e.energy_before},
          {"energy_after", &e.energy_after},
          {"cells_x", &e.cells[0]},
          {"cells_y", &e.cells[1]},
          {"cells_z", &e.cells[2]}};
}

std::vector<Measures> read_history(const std::filesystem::path& file) {
  return read_records<Measures>(file, "history");
}

std::vector<Event> read_events(const std::filesystem::path& file) {
  return read_records<Event>(file, "table of events");
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
