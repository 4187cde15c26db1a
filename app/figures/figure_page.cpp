#include "figures/figure_page.h"

#include "error.h"
#include "figures/outcome.h"
#include "figures/study.h"
#include "render/energy_plot.h"
#include "render/labels.h"
#include "tradeoff/reference.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

using render::Block;
using render::Heading;
using render::StoredStates;

constexpr double page_width = 2800; ///< 178 mm, two columns of a journal

/// The states that a panel shows. Throws SceneError for a time that the run does not come to.
std::vector<render::State> states_of(const StoredStates& run, const MembranePanel& panel) {
  const auto& frames = run.frames();
  std::vector<double> times = panel.times;
  if (times.empty()) times = {frames.front().time, frames.back().time};
  const double end = frames.back().time, slack = end / double(frames.size());
  std::vector<render::State> states;
  for (const double time : times) {
    if (time > end + slack)
      throw SceneError(fmt::format("{}: the run ends at t = {:g}, before the time {:g} that is to "
                                   "be shown",
                                   panel.run.scene, end, time));
    states.push_back(run.at(time));
  }
  return states;
}

/// What the exact solution of a built-in scene says of a column; no points where there is none.
render::Series exact_series(const StoredStates& run, const RunSpec& spec,
                            const std::string& column) {
  render::Series series{"exact", render::style::ink};
  series.dashed = true;
  series.width = render::style::hairline * 1.5;
  Scene scene = run.scene();
  scene.name = spec.scene;
  const std::optional<Reference> reference = builtin_reference(scene);
  if (!reference || reference->at_rest()) return series;
  for (const Measures& m : run.history()) {
    if (m.time == 0) continue;
    const auto scaled = [&](const char* name, double value) {
      return render::notation_of(name).value(value, run.units());
    };
    series.points.push_back(
        {scaled("t", m.time), scaled(column.c_str(), reference->at(m.time).value(column))});
  }
  return series;
}

std::string name_of(const PlotPanel& panel, std::size_t n, const StoredStates& run,
                    const std::string& column) {
  if (!panel.names.empty()) return panel.names[n];
  const render::Notation& notation = render::notation_of(column);
  if (panel.y.size() > 1) return panel.label.empty() ? notation.symbol() : notation.short_symbol();
  return panel.exact ? render::grid_label(run.scene().nodes) : "";
}

render::Plot plot_of_columns(const PlotPanel& panel, const RunFinder& find_run) {
  render::Plot plot;
  std::optional<render::Units> units;
  auto color = render::style::curves.begin();
  for (std::size_t r = 0; r < panel.runs.size(); ++r) {
    const StoredStates run(find_run(panel.runs[r]));
    units = units ? common(*units, run.units()) : run.units();
    for (const std::string& column : panel.y) {
      render::Series series{name_of(panel, r, run, column), *color++};
      for (const Measures& m : run.history())
        series.points.push_back({run.value(m, panel.x), run.value(m, column)});
      plot.series.push_back(std::move(series));
      if (panel.exact) plot.series.push_back(exact_series(run, panel.runs[r], column));
    }
  }
  render::Notation y = render::notation_of(panel.y.front());
  if (!panel.label.empty()) y.name = panel.label, y.letter.clear();
  plot.x.title = render::notation_of(panel.x).title(*units);
  plot.y.title = y.title(*units);
  return plot;
}

render::Plot plot_of_terms(const StoredStates& run) {
  return render::energy_plot(run.history(), run.units());
}

/// The page under construction.
class Builder {
public:
  Builder(const FigureSpec& figure, const RunFinder& find_run)
      : figure_(figure), find_run_(find_run) {}

  render::Page build() {
    render::Page page(page_width);
    std::vector<render::Page::Part> row;
    int filled = 0;
    for (const PanelSpec& panel : figure_.panels) {
      if (filled + panel.span > figure_.columns) {
        page.add_row(std::exchange(row, {}), figure_.columns);
        filled = 0;
      }
      row.push_back({block(panel), double(panel.span)});
      filled += panel.span;
    }
    page.add_row(std::move(row), figure_.columns);
    page.add(std::make_unique<render::TextBlock>(caption()));
    return page;
  }

  std::vector<FigureTable> tables;
  std::vector<std::string> surprises;

private:
  Heading heading(const PanelSpec& panel) {
    const bool lettered = panel.lettered && figure_.panels.size() > 1;
    return {lettered ? std::string(1, char('a' + letters_++)) : std::string(), panel.title};
  }

  std::unique_ptr<Block> block(const PanelSpec& panel) {
    const Heading head = heading(panel);
    return std::visit([&](const auto& content) { return block(content, head, panel.span); },
                      panel.content);
  }

  std::unique_ptr<Block> block(const MembranePanel& panel, const Heading& head, int span) {
    const StoredStates run(find_run_(panel.run));
    note(panel.run, run.scene());
    const std::vector<render::State> states = states_of(run, panel);
    for (const std::string& surprise : lamella::surprises(states.back(), panel.expect))
      surprises.push_back(fmt::format("panel {}{}, {} at t = {:g}: {}", head.letter,
                                      head.title.empty() ? "" : " (" + head.title + ")",
                                      panel.run.scene, states.back().frame.time, surprise));
    std::vector<render::Surface> surfaces;
    for (const render::State& state : states)
      surfaces.push_back(extract_surface(state, panel.view.color));
    const double cell = page_width / figure_.columns * span / double(states.size());
    return std::make_unique<render::Strip>(head, std::move(surfaces), panel.view,
                                           std::min(800.0, 1.1 * cell));
  }

  std::unique_ptr<Block> block(const PlotPanel& panel, const Heading& head, int) {
    for (const RunSpec& run : panel.runs) note(run, StoredStates(find_run_(run)).scene());
    return std::make_unique<render::PlotBlock>(head, plot_of(panel, find_run_));
  }

  std::unique_ptr<Block> block(const TablePanel& panel, const Heading& head, int) {
    tables.push_back(table_of(panel.study, evaluated(panel.study)));
    return std::make_unique<render::TableBlock>(head, tables.back().cells(), 2);
  }

  std::unique_ptr<Block> block(const ConvergencePanel& panel, const Heading& head, int) {
    return std::make_unique<render::PlotBlock>(
        head, convergence_plot(panel.study, evaluated(panel.study)));
  }

  StudyResult evaluated(const Study& study) {
    for (std::size_t n = 0; n < study.values.size(); ++n) {
      const RunSpec run = run_of(study, n);
      note(run, StoredStates(find_run_(run)).scene());
    }
    return evaluate(study, find_run_);
  }

  /// For the caption: what was run on which grid.
  void note(const RunSpec& run, const Scene& scene) {
    const std::string text = fmt::format("{} ({})", run.scene, render::grid_label(scene.nodes));
    if (std::ranges::find(runs_, text) == runs_.end()) runs_.push_back(text);
  }

  std::string caption() const {
    const std::string stop = figure_.title.ends_with('.') ? "" : ".";
    const std::string title =
        figure_.title.empty() ? "" : fmt::format("**{}{}** ", figure_.title, stop);
    return fmt::format("{}{} Scenes: {}.", title, figure_.caption, fmt::join(runs_, ", "));
  }

  const FigureSpec& figure_;
  const RunFinder& find_run_;
  int letters_ = 0;
  std::vector<std::string> runs_;
};

} // namespace

render::Plot plot_of(const PlotPanel& panel, const RunFinder& find_run) {
  render::Plot plot = panel.y.front() == terms
                          ? plot_of_terms(StoredStates(find_run(panel.runs.front())))
                          : plot_of_columns(panel, find_run);
  plot.x.logarithmic = panel.log_x;
  plot.y.logarithmic = panel.log_y;
  plot.x.range = panel.x_range;
  plot.y.range = panel.y_range;
  return plot;
}

FigurePage draw_figure(const FigureSpec& figure, const RunFinder& find_run, render::Camera camera) {
  Builder builder(figure, find_run);
  const render::Page page = builder.build();
  return {page.draw(camera), std::move(builder.tables), std::move(builder.surprises)};
}

} // namespace lamella
