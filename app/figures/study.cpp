#include "figures/study.h"

#include "error.h"
#include "render/labels.h"
#include "scene/keys.h"
#include "store/history.h"
#include "tradeoff/reference.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace lamella {
namespace {

using render::notation_of;
using render::StoredStates;
using render::Vec2;
using render::with_unit;

/// Time mean of values between two times, by trapezia.
template <class Value>
double mean(const std::vector<double>& times, const std::array<double, 2>& window, Value&& value) {
  double sum = 0, extent = 0;
  for (std::size_t n = 1; n < times.size(); ++n) {
    const double begin = std::max(times[n - 1], window[0]), end = std::min(times[n], window[1]);
    if (!(begin < end)) continue;
    sum += (end - begin) * (value(n - 1) + value(n)) / 2;
    extent += end - begin;
  }
  return sum / extent;
}

/// In the unit of pictures; at the end, or over the window.
double value_of_run(const StoredStates& run, const Study& study, const std::string& column) {
  const std::vector<Measures>& history = run.history();
  if (!study.window) return run.value(history.back(), column);
  std::vector<double> times;
  for (const Measures& m : history) times.push_back(m.time);
  return mean(times, *study.window, [&](std::size_t n) { return run.value(history[n], column); });
}

/// From the exact solution that comes with the scene, in the unit of pictures.
double builtin_exact(const StoredStates& run, const Study& study, const std::string& column) {
  Scene scene = run.scene();
  scene.name = study.run.scene;
  const std::optional<Reference> reference = builtin_reference(scene);
  if (!reference) return NAN;
  const auto at = [&](double time) {
    return notation_of(column).value(reference->at(time).value(column), run.units());
  };
  if (!study.window) return at(scene.end());
  std::vector<double> times(201);
  for (std::size_t n = 0; n < times.size(); ++n)
    times[n] = std::lerp((*study.window)[0], (*study.window)[1], double(n) / 200);
  return mean(times, *study.window, [&](std::size_t n) { return at(times[n]); });
}

bool varies_grid(const Study& study) { return study.vary == "grid.nodes"; }

/// As the run has it: --set may have the last word.
double varied_in(const Scene& scene, const Study& study) {
  if (varies_grid(study)) return scene.grid().spacing;
  const auto keys = scene_keys();
  return std::stod(value_text(*std::ranges::find(keys, study.vary, &Key::path), scene));
}

std::string label_of(const Scene& scene, const Study& study) {
  return varies_grid(study) ? render::grid_label(scene.nodes)
                            : render::number(varied_in(scene, study));
}

std::string cell(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "–";
}

std::string minus(std::string text) {
  return text.starts_with('-') ? std::string("−").append(text, 1) : text;
}

/// For files: without the marks of typesetting.
std::string bare(std::string text) {
  for (const std::string_view mark : {"*", "_{", "}"})
    for (std::size_t at = 0; (at = text.find(mark)) != text.npos;) text.erase(at, mark.size());
  return text;
}

/// What is varied, in words, and the unit in which a scene gives it.
std::pair<std::string, std::string> name_and_unit(const std::string& path) {
  if (path == "grid.nodes") return {"grid", ""};
  if (path == "numerics.tolerance") return {"tolerance", "*h*"};
  const auto keys = scene_keys();
  return {path, std::string(std::ranges::find(keys, path, &Key::path)->unit)};
}

/// With the marks of Markdown.
std::string marked(std::string text) {
  for (const auto& [mark, tag] : {std::pair("_{", "<sub>"), std::pair("}", "</sub>")})
    for (std::size_t at = 0; (at = text.find(mark)) != text.npos;)
      text.replace(at, std::string_view(mark).size(), tag);
  return text;
}

bool knows_paper(const Study& study, std::size_t quantity) {
  return std::ranges::any_of(study.paper,
                             [&](const auto& row) { return std::isfinite(row[quantity]); });
}

double largest(const StudyResult& result, std::size_t quantity) {
  double most = 0;
  for (const auto& row : result.values)
    if (std::isfinite(row[quantity])) most = std::max(most, std::abs(row[quantity]));
  return most;
}

} // namespace

StudyResult evaluate(const Study& study, const RunFinder& find_run) {
  StudyResult result;
  result.exact = study.exact;
  for (std::size_t n = 0; n < study.values.size(); ++n) {
    const StoredStates run(find_run(run_of(study, n)));
    if (result.exact.empty())
      for (const std::string& column : study.quantities)
        result.exact.push_back(builtin_exact(run, study, column));
    result.units = n == 0 ? run.units() : common(result.units, run.units());
    result.varied.push_back(varied_in(run.scene(), study));
    result.labels.push_back(label_of(run.scene(), study));
    result.values.emplace_back();
    for (const std::string& column : study.quantities)
      result.values.back().push_back(value_of_run(run, study, column));
  }
  return result;
}

/// A column for each quantity, then its error where the exact value is known, and the paper's where
/// that is known too.
FigureTable table_of(const Study& study, const StudyResult& result) {
  FigureTable table;
  const auto& [vary, vary_unit] = name_and_unit(study.vary);
  table.names.push_back(vary);
  table.units.push_back(vary_unit);
  for (const std::string& label : result.labels) table.rows.push_back({label});
  const bool is_known =
      std::ranges::any_of(result.exact, [](double x) { return std::isfinite(x); });
  if (is_known) table.rows.push_back({"exact"});
  for (std::size_t q = 0; q < study.quantities.size(); ++q) {
    const render::Notation& notation = notation_of(study.quantities[q]);
    const int exponent = render::exponent_of(largest(result, q));
    const double power = std::pow(10, exponent), exact = result.exact[q] / power;
    const auto value = [&](std::size_t n) { return result.values[n][q] / power; };
    const std::string unit = render::with_power(exponent, notation.unit(result.units));
    const auto column = [&](const std::string& name, auto&& cell_of, const std::string& last) {
      table.names.push_back(name);
      table.units.push_back(unit);
      for (std::size_t n = 0; n < study.values.size(); ++n)
        table.rows[n].push_back(minus(cell_of(n)));
      if (is_known) table.rows.back().push_back(minus(last));
    };
    column(
        notation.symbol(), [&](std::size_t n) { return cell(value(n), "{:.4f}"); },
        cell(exact, "{:.4f}"));
    if (!std::isfinite(exact)) continue;
    column(
        "error", [&](std::size_t n) { return cell(value(n) - exact, "{:+.4f}"); }, "");
    if (knows_paper(study, q))
      column(
          "paper's",
          [&](std::size_t n) { return cell(study.paper[n][q] / power - exact, "{:+.3f}"); }, "");
  }
  return table;
}

double fitted_order(const std::vector<Vec2>& points) {
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& [a, b] : points) {
    const double p = std::log(a), q = std::log(b);
    x += p, y += q, xx += p * p, xy += p * q;
  }
  const double count = double(points.size());
  return points.size() < 2 ? NAN : (count * xy - x * y) / (count * xx - x * x);
}

render::Plot convergence_plot(const Study& study, const StudyResult& result) {
  const auto& [vary, vary_unit] = name_and_unit(study.vary);
  render::Plot plot{
      {varies_grid(study) ? "grid spacing *h* / *L*" : with_unit(vary, vary_unit), true},
      {"relative error", true},
      {}};
  bool paper_is_named = false;
  for (std::size_t q = 0; q < study.quantities.size(); ++q) {
    const render::Color color = render::style::curves[q];
    const render::Notation& notation = notation_of(study.quantities[q]);
    render::Series ours{"", color}, paper{"", color};
    for (std::size_t n = 0; n < study.values.size(); ++n) {
      const double at = result.varied[n], exact = result.exact[q];
      ours.points.push_back({at, std::abs(result.values[n][q] / exact - 1)});
      if (!study.paper.empty() && std::isfinite(study.paper[n][q]))
        paper.points.push_back({at, std::abs(study.paper[n][q] / exact - 1)});
    }
    std::ranges::sort(ours.points);
    std::ranges::sort(paper.points);
    const double order = fitted_order(ours.points);
    ours.name = notation.short_symbol();
    if (order > 0) ours.name += fmt::format(", order {:.1f}", order);
    ours.dots = paper.dots = true;
    paper.dashed = true;
    paper.width /= 2;
    paper.hollow.assign(paper.points.size(), true);
    if (!paper.points.empty() && !std::exchange(paper_is_named, true)) paper.name = "paper";
    plot.series.push_back(std::move(ours));
    if (!paper.points.empty()) plot.series.push_back(std::move(paper));
  }
  return plot;
}

render::TableCells FigureTable::cells() const {
  render::TableCells all{names, units};
  all.insert(all.end(), rows.begin(), rows.end());
  return all;
}

std::string FigureTable::csv() const {
  std::string text;
  const auto add = [&](const std::vector<std::string>& row) {
    std::vector<std::string> plain;
    for (const std::string& each : row) {
      std::string value = bare(each);
      if (value == "–") value.clear();
      if (value.starts_with("−")) value.replace(0, std::string_view("−").size(), "-");
      plain.push_back(value);
    }
    text += fmt::format("{}\n", fmt::join(plain, ","));
  };
  add(titles());
  std::ranges::for_each(rows, add);
  return text;
}

std::string FigureTable::markdown() const {
  const auto line = [](const std::vector<std::string>& row) {
    return marked(fmt::format("| {} |\n", fmt::join(row, " | ")));
  };
  std::string text = line(titles()) + "|---|";
  for (std::size_t c = 1; c < names.size(); ++c) text += "---:|";
  text += "\n";
  for (const auto& row : rows) text += line(row);
  return text;
}

std::vector<std::string> FigureTable::titles() const {
  std::vector<std::string> all;
  for (std::size_t c = 0; c < names.size(); ++c) all.push_back(with_unit(names[c], units[c]));
  return all;
}

} // namespace lamella
