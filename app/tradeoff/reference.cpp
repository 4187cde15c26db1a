#include "tradeoff/reference.h"

#include "error.h"
#include "regular_file.h"
#include "scene/builtin.h"
#include "tradeoff/builtin_references.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>

namespace lamella {

namespace {

using Column = double ReferenceState::*;

/// What a column is, null where it does not count.
Column column(std::string_view name) {
  static constexpr std::pair<std::string_view, Column> columns[]{
      {"t", &ReferenceState::time},         {"energy", &ReferenceState::energy},
      {"E", &ReferenceState::energy},       {"int_KM2", &ReferenceState::int_KM2},
      {"intKM2", &ReferenceState::int_KM2}, {"P", &ReferenceState::P},
      {"sigma", &ReferenceState::sigma},
  };
  for (const auto& [known, member] : columns)
    if (known == name) return member;
  return nullptr;
}

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> all;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) all.push_back(cell);
  return all;
}

std::optional<double> number(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

double between(double a, double b, double weight) { return a + (b - a) * weight; }

double relative_error(double value, double exact) {
  return exact == 0 ? ReferenceState::unknown : std::abs(value / exact - 1);
}

/// Of the energy, or where it is not known of int K_M^2 dA.
double energy_error(const Measures& m, const ReferenceState& exact) {
  return std::isnan(exact.energy) ? relative_error(m.int_KM2, exact.int_KM2)
                                  : relative_error(m.energy, exact.energy);
}

/// Mean of the energy's error over the logarithm of time, all steps of the last two decades.
double course_error(std::span<const Measures> history, const Reference& reference) {
  const double begin = history.back().time / 100;
  double sum = 0, extent = 0;
  for (std::size_t i = 1; i < history.size(); ++i) {
    const Measures &a = history[i - 1], &b = history[i];
    if (a.time < begin) continue;
    const double width = std::log(b.time / a.time);
    sum +=
        width * (energy_error(a, reference.at(a.time)) + energy_error(b, reference.at(b.time))) / 2;
    extent += width;
  }
  return sum / extent;
}

/// But for what does not change the solution.
bool same_physics(Scene scene, const Scene& builtin) {
  scene.title = builtin.title;
  scene.nodes = builtin.nodes;
  scene.end_time = builtin.end_time;
  scene.numerics = builtin.numerics;
  scene.output = builtin.output;
  return scene == builtin;
}

} // namespace

Reference::Reference(std::string_view table, std::string source) : source_(std::move(source)) {
  std::istringstream lines{std::string(table)};
  std::string line;
  std::getline(lines, line);
  std::vector<Column> columns;
  for (const std::string& name : cells(line)) columns.push_back(column(name));
  const auto counts = [&](Column c) { return std::ranges::count(columns, c) > 0; };
  if (!counts(&ReferenceState::energy) && !counts(&ReferenceState::int_KM2))
    throw SceneError(fmt::format("{}: no reference; its first line must name columns, among them "
                                 "energy or int_KM2",
                                 source_));
  for (int row = 2; std::getline(lines, line); ++row) {
    const std::vector<std::string> texts = cells(line);
    ReferenceState state;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (!columns[i]) continue;
      const std::optional<double> value = i < texts.size() ? number(texts[i]) : std::nullopt;
      if (!value)
        throw SceneError(fmt::format("{}:{}: column {} holds no number", source_, row, i + 1));
      state.*columns[i] = *value;
    }
    if (!states_.empty() && !(state.time > states_.back().time))
      throw SceneError(
          fmt::format("{}:{}: times must ascend; a table without t has one row", source_, row));
    states_.push_back(state);
  }
  if (states_.empty()) throw SceneError(source_ + ": the reference has no rows");
}

double ReferenceState::value(std::string_view column) const {
  if (column == "int_KM2") return int_KM2;
  if (column == "P") return P;
  if (column == "sigma") return sigma;
  if (column != "energy") return unknown;
  return std::isnan(energy) ? int_KM2 / 2 : energy;
}

Reference::Reference(std::span<const Measures> history, std::string source)
    : source_(std::move(source)) {
  for (const Measures& m : history) states_.push_back({m.time, m.energy, m.int_KM2, m.P, m.sigma});
}

ReferenceState Reference::at(double time) const {
  const auto after = std::ranges::lower_bound(states_, time, {}, &ReferenceState::time);
  if (after == states_.end()) return states_.back();
  if (after == states_.begin()) return states_.front();
  const ReferenceState &a = *(after - 1), &b = *after;
  const double weight = a.time > 0 ? std::log(time / a.time) / std::log(b.time / a.time)
                                   : (time - a.time) / (b.time - a.time);
  return {time, between(a.energy, b.energy, weight), between(a.int_KM2, b.int_KM2, weight),
          between(a.P, b.P, weight), between(a.sigma, b.sigma, weight)};
}

Reference read_reference(const std::filesystem::path& file) {
  return {file_text(file), file.string()};
}

std::optional<Reference> builtin_reference(const Scene& scene) {
  for (const BuiltinReference& known : builtin_references()) {
    if (known.scene != scene.name) continue;
    const Scene builtin = builtin_scene(known.scene);
    const Reference reference(known.table, std::string(known.file));
    const bool rests = !reference.at_rest() || scene.end() >= builtin.end();
    if (same_physics(scene, builtin) && rests && reference.covers(scene.end())) return reference;
  }
  return {};
}

double Errors::largest() const { return std::fmax(std::fmax(course, energy), std::fmax(P, sigma)); }

Errors compare(std::span<const Measures> history, const Reference& reference) {
  const Measures& end = history.back();
  const ReferenceState exact = reference.at(end.time);
  return {.course =
              reference.at_rest() ? ReferenceState::unknown : course_error(history, reference),
          .energy = energy_error(end, exact),
          .P = relative_error(end.P, exact.P),
          .sigma = relative_error(end.sigma, exact.sigma)};
}

} // namespace lamella
