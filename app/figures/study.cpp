#include "figures/study.h"

#include "error.h"
#include "render/labels.h"
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

using render::StoredStates;
using render::Vec2;

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

double column_value(const Measures& measures, const std::string& column) {
  const std::optional<double> value = value_of(measures, column);
  if (!value) throw SceneError(fmt::format("{}: not a column of this run's history.csv", column));
  return *value;
}

/// At the end, or over the window.
double value_of_run(const StoredStates& run, const Study& study, const std::string& column) {
  const std::vector<Measures>& history = run.history();
  if (!study.window) return column_value(history.back(), column);
  std::vector<double> times;
  for (const Measures& m : history) times.push_back(m.time);
  return mean(times, *study.window,
              [&](std::size_t n) { return column_value(history[n], column); });
}

/// From the exact solution that comes with the scene.
double builtin_exact(const StoredStates& run, const Study& study, const std::string& column) {
  Scene scene = run.scene();
  scene.name = study.run.scene;
  const std::optional<Reference> reference = builtin_reference(scene);
  if (!reference) return NAN;
  const auto at = [&](double time) {
    const ReferenceState state = reference->at(time);
    if (column == "int_KM2") return state.int_KM2;
    if (column == "P") return state.P;
    if (column == "sigma") return state.sigma;
    return column == "energy" ? state.energy : NAN;
  };
  if (!study.window) return at(scene.end_time);
  std::vector<double> times(201);
  for (std::size_t n = 0; n < times.size(); ++n)
    times[n] = std::lerp((*study.window)[0], (*study.window)[1], double(n) / 200);
  return mean(times, *study.window, [&](std::size_t n) { return at(times[n]); });
}

std::string label_of(const Study& study, std::size_t n) {
  return study.vary == "grid.nodes" ? fmt::format("{:g}³", study.values[n])
                                    : render::number(study.values[n]);
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

/// What is varied, in words.
std::string name_of(const std::string& key) {
  if (key == "grid.nodes") return "grid";
  return key == "numerics.tolerance" ? "tolerance / *h*" : key;
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

} // namespace

std::string Notation::title() const {
  if (unit.empty()) return symbol;
  return unit.find('/') == unit.npos ? symbol + " / " + unit : symbol + " / (" + unit + ")";
}

Notation notation_of(const std::string& column) {
  static const std::map<std::string, Notation> known{
      {"t", {"time *t*", "*ζL*⁴/*κ*"}},
      {"energy", {"energy *E*", "*κ*"}},
      {"bending_energy", {"bending energy", "*κ*"}},
      {"int_KM2", {"∫ *K*_{M}² d*A*", ""}},
      {"P", {"pressure *P*", "*κ*/*L*³"}},
      {"sigma", {"tension *σ*", "*κ*/*L*²"}},
      {"sigma_Ld", {"tension *σ*_{Ld}", "*κ*/*L*²"}},
      {"sigma_Lo", {"tension *σ*_{Lo}", "*κ*/*L*²"}},
      {"v", {"reduced volume *v*", ""}},
      {"Da", {"area difference Δ*a*", ""}},
      {"dA_rel", {"error of the area", ""}},
      {"dV_rel", {"error of the volume", ""}},
      {"max_speed", {"largest speed", "*κ*/*ζL*³"}},
      {"line_energy", {"line energy", "*κ*"}},
      {"bending_Ld", {"bending of Ld", "*κ*"}},
      {"bending_Lo", {"bending of Lo", "*κ*"}},
      {"line_length", {"length of the boundary", "*L*"}},
      {"line_radius", {"radius of the boundary", "*L*"}},
      {"components", {"components", ""}},
      {"domains_Ld", {"Ld domains", ""}},
      {"c_min", {"least *c*", ""}},
      {"c_max", {"greatest *c*", ""}}};
  const auto found = known.find(column);
  return found == known.end() ? Notation{column, ""} : found->second;
}

StudyResult evaluate(const Study& study, const RunFinder& find_run) {
  StudyResult result;
  result.exact = study.exact;
  for (std::size_t n = 0; n < study.values.size(); ++n) {
    const StoredStates run(find_run(run_of(study, n)));
    if (result.exact.empty())
      for (const std::string& column : study.quantities)
        result.exact.push_back(builtin_exact(run, study, column));
    result.spacings.push_back(run.scene().grid().spacing);
    result.labels.push_back(label_of(study, n));
    result.values.emplace_back();
    for (const std::string& column : study.quantities)
      result.values.back().push_back(value_of_run(run, study, column));
  }
  return result;
}

/// A column for each quantity, then its error, and the paper's where that is known.
FigureTable table_of(const Study& study, const StudyResult& result) {
  FigureTable table;
  std::vector<std::string> head{name_of(study.vary)};
  std::vector<std::string> last{"exact"};
  for (std::size_t q = 0; q < study.quantities.size(); ++q) {
    head.push_back(notation_of(study.quantities[q]).symbol);
    last.push_back(minus(cell(result.exact[q], "{:.4f}")));
    head.emplace_back("error");
    last.emplace_back("");
    if (knows_paper(study, q)) head.emplace_back("paper's"), last.emplace_back("");
  }
  table.cells.push_back(head);
  for (std::size_t n = 0; n < study.values.size(); ++n) {
    std::vector<std::string> row{result.labels[n]};
    for (std::size_t q = 0; q < study.quantities.size(); ++q) {
      const double value = result.values[n][q], exact = result.exact[q];
      row.push_back(minus(cell(value, "{:.4f}")));
      row.push_back(minus(cell(value - exact, "{:+.4f}")));
      if (knows_paper(study, q)) row.push_back(minus(cell(study.paper[n][q] - exact, "{:+.3f}")));
    }
    table.cells.push_back(row);
  }
  table.cells.push_back(last);
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
  constexpr render::Color colors[]{render::style::membrane.line, render::style::Lo.line,
                                   render::style::gaussian_energy, render::style::line_energy,
                                   render::style::stretch_energy};
  const bool grids = study.vary == "grid.nodes";
  render::Plot plot{
      {grids ? "grid spacing *h* / *L*" : name_of(study.vary), true}, {"relative error", true}, {}};
  bool paper_is_named = false;
  for (std::size_t q = 0; q < study.quantities.size(); ++q) {
    const render::Color color = colors[q % std::size(colors)];
    const Notation notation = notation_of(study.quantities[q]);
    render::Series ours{"", color}, paper{"", color};
    for (std::size_t n = 0; n < study.values.size(); ++n) {
      const double at = grids ? result.spacings[n] : study.values[n], exact = result.exact[q];
      ours.points.push_back({at, std::abs(result.values[n][q] / exact - 1)});
      if (!study.paper.empty() && std::isfinite(study.paper[n][q]))
        paper.points.push_back({at, std::abs(study.paper[n][q] / exact - 1)});
    }
    std::ranges::sort(ours.points);
    std::ranges::sort(paper.points);
    const double order = fitted_order(ours.points);
    ours.name = notation.symbol.substr(notation.symbol.rfind(' ') + 1);
    if (notation.symbol.find("∫") != std::string::npos) ours.name = notation.symbol;
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

std::string FigureTable::csv() const {
  std::string text;
  for (const auto& row : cells) {
    std::vector<std::string> plain;
    for (const std::string& each : row) {
      std::string value = bare(each);
      if (value == "–") value.clear();
      if (value.starts_with("−")) value.replace(0, std::string_view("−").size(), "-");
      plain.push_back(value);
    }
    text += fmt::format("{}\n", fmt::join(plain, ","));
  }
  return text;
}

std::string FigureTable::markdown() const {
  std::string text;
  for (std::size_t r = 0; r < cells.size(); ++r) {
    text += marked(fmt::format("| {} |\n", fmt::join(cells[r], " | ")));
    if (r > 0) continue;
    text += "|";
    for (std::size_t c = 0; c < cells[r].size(); ++c) text += c == 0 ? "---|" : "---:|";
    text += "\n";
  }
  return text;
}

} // namespace lamella
