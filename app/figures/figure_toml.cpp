#include "figures/figure_spec.h"

#include "error.h"
#include "nearest.h"
#include "scene/document.h"
#include "scene/keys.h"
#include "scene/units.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace lamella {
namespace {

/// The keys of a table of a figure's file, each of which must be asked for.
class Keys {
public:
  Keys(const toml::table& table, std::string source, std::string label)
      : table_(table), source_(std::move(source)), label_(std::move(label)) {}

  /// A value, where the key is there.
  template <class T>
  void take(std::string_view name, T& value, const std::string& allowed) {
    asked_.emplace_back(name);
    const toml::node* node = table_.get(name);
    if (node && !assign(value, *node)) refuse(name, *node, "does not fit", allowed);
  }

  void check(std::string_view name, bool good, const std::string& allowed) const {
    if (!good) refuse(name, *table_.get(name), "is not possible", allowed);
  }

  void require(std::string_view name, const std::string& allowed) const {
    if (table_.contains(name)) return;
    refuse_scene(fmt::format("{}:{}: {}{}: is missing; allowed: {}", source_,
                             table_.source().begin.line, label_, name, allowed));
  }

  bool has(std::string_view name) const { return table_.contains(name); }

  void refuse_others() const {
    const std::vector<std::string_view> names(asked_.begin(), asked_.end());
    for (const auto& [key, value] : table_)
      if (std::ranges::find(asked_, key.str()) == asked_.end())
        refuse_scene(fmt::format("{}:{}: {}{}: unknown key; allowed: {}{}", source_,
                                 key.source().begin.line, label_, shortened(key.str()),
                                 fmt::join(names, ", "), suggestion(key.str(), names)));
  }

  const toml::table* table(std::string_view name) {
    asked_.emplace_back(name);
    return table_[name].as_table();
  }

private:
  [[noreturn]] void refuse(std::string_view name, const toml::node& node, const char* what,
                           const std::string& allowed) const {
    refuse_scene(fmt::format("{}:{}: {}{}: this value {}; allowed: {}", source_,
                             node.source().begin.line, label_, name, what, allowed));
  }

  static bool assign(std::string& value, const toml::node& node) {
    if (!node.is_string()) return false;
    value = node.as_string()->get();
    return true;
  }
  static bool assign(bool& value, const toml::node& node) {
    if (!node.is_boolean()) return false;
    value = node.as_boolean()->get();
    return true;
  }
  static bool assign(int& value, const toml::node& node) {
    const auto number = node.is_integer() ? node.value<int>() : std::nullopt;
    if (number) value = *number;
    return number.has_value();
  }
  static bool assign(double& value, const toml::node& node) {
    if (!node.is_number()) return false;
    value = *node.value<double>();
    return true;
  }
  template <class T>
  static bool assign(std::optional<T>& value, const toml::node& node) {
    return assign(value.emplace(), node);
  }
  template <class T, std::size_t N>
  static bool assign(std::array<T, N>& value, const toml::node& node) {
    std::vector<T> list;
    if (!node.is_array() || !assign(list, node) || list.size() != N) return false;
    std::ranges::copy(list, value.begin());
    return true;
  }
  static bool assign(render::ValueRange& value, const toml::node& node) {
    std::array<double, 2> ends{};
    if (!assign(ends, node) || !(ends[0] < ends[1])) return false;
    value = {ends[0], ends[1]};
    return true;
  }
  template <class T>
  static bool assign(std::vector<T>& values, const toml::node& node) {
    const toml::array* list = node.as_array();
    values.clear();
    if (!list) return assign(values.emplace_back(), node);
    for (const toml::node& each : *list)
      if (T value{}; assign(value, each))
        values.push_back(std::move(value));
      else
        return false;
    return true;
  }

  const toml::table& table_;
  std::string source_, label_;
  std::vector<std::string> asked_;
};

constexpr const char* finite_numbers = "a list of numbers";
const std::string scene_text = "a scene file or the name of a built-in scene, in quotes";
const std::string set_text = "a list of texts as after --set, such as [\"grid.nodes=96\"]";
const std::string columns_text = "columns of history.csv, such as [\"energy\", \"P\"]";

RunSpec run_in(Keys& keys) {
  RunSpec run;
  keys.require("scene", scene_text);
  keys.take("scene", run.scene, scene_text);
  keys.take("set", run.set, set_text);
  return run;
}

bool ascending(const std::vector<double>& values) {
  return std::ranges::adjacent_find(values, std::greater_equal<>()) == values.end();
}

void take_color(Keys& keys, render::View& view) {
  const std::string text =
      fmt::format("\"{}\", or a field of the scene", fmt::join(render::quantity_names, "\", \""));
  keys.take("color", view.color.name, text);
  const std::string& name = view.color.name;
  keys.check("color", render::is_quantity(name), text + suggestion(name, render::quantity_names));
}

/// A number, or a range of two.
Expectations expectations(const toml::table& table, const std::string& source) {
  Expectations expect;
  Keys keys(table, source, "[panel.expect] ");
  for (const auto& [key, value] : table) {
    std::vector<double> ends;
    keys.take(key.str(), ends, "a number or a range [least, most]");
    keys.check(key.str(), ends.size() == 1 || (ends.size() == 2 && ends[0] <= ends[1]),
               "a number or a range [least, most]");
    expect[std::string(key.str())] = {ends.front(), ends.back()};
  }
  return expect;
}

MembranePanel membrane_in(Keys& keys, const std::string& source) {
  MembranePanel panel;
  panel.run = run_in(keys);
  const std::string times = "times from 0 on, in ascending order";
  keys.take("times", panel.times, times);
  keys.check("times",
             !keys.has("times") ||
                 (!panel.times.empty() && panel.times.front() >= 0 && ascending(panel.times)),
             times);
  keys.take("elevation", panel.view.elevation, "degrees from -90 to 90");
  if (panel.view.elevation)
    keys.check("elevation", std::abs(*panel.view.elevation) <= 90, "degrees from -90 to 90");
  keys.take("azimuth", panel.view.azimuth, "degrees");
  take_color(keys, panel.view);
  keys.take("range", panel.view.range, "two numbers, the lower one first");
  keys.take("sections", panel.view.section, "true or false");
  if (const toml::table* table = keys.table("expect")) panel.expect = expectations(*table, source);
  return panel;
}

bool are_columns(const std::vector<std::string>& names) {
  return std::ranges::all_of(names, render::find_notation);
}

/// What one plot can show: an axis has one unit, and no two curves share a colour.
void check_curves(const Keys& keys, const PlotPanel& panel) {
  if (panel.y == std::vector{std::string(terms)}) {
    keys.check("scenes", panel.runs.size() == 1, "one scene, with y = \"terms\"");
    return;
  }
  keys.check("y", !panel.y.empty() && are_columns(panel.y), columns_text + ", or \"terms\"");
  const auto dimension = [](const std::string& column) {
    return dimension_of(render::notation_of(column).unit_in_scene);
  };
  keys.check("y",
             std::ranges::all_of(
                 panel.y, [&](const auto& y) { return dimension(y) == dimension(panel.y[0]); }),
             "columns of one unit; a panel of its own for each other one");
  constexpr std::size_t most = render::style::curves.size();
  keys.check("y", panel.runs.size() * panel.y.size() <= most,
             fmt::format("at most {} curves in a plot, a colour each", most));
}

PlotPanel plot_in(Keys& keys) {
  PlotPanel panel;
  std::vector<std::string> scenes, set;
  keys.require("scenes", scene_text);
  keys.take("scenes", scenes, "scene files or names of built-in scenes");
  keys.take("set", set, set_text);
  keys.check("scenes", !scenes.empty(), scene_text);
  for (const std::string& scene : scenes) panel.runs.push_back({scene, set});
  keys.take("names", panel.names, "a name for each of the scenes");
  keys.check("names", panel.names.empty() || panel.names.size() == scenes.size(),
             "a name for each of the scenes");
  keys.take("x", panel.x, "a column of history.csv");
  keys.check("x", render::find_notation(panel.x), "a column of history.csv");
  keys.require("y", columns_text + ", or \"terms\"");
  keys.take("y", panel.y, columns_text + ", or \"terms\"");
  check_curves(keys, panel);
  std::vector<std::string> log;
  const std::string axes = "\"x\", \"y\" or both";
  keys.take("log", log, axes);
  for (const std::string& axis : log) {
    keys.check("log", axis == "x" || axis == "y", axes);
    (axis == "x" ? panel.log_x : panel.log_y) = true;
  }
  const std::string range = "two numbers, the lower one first";
  keys.take("x_range", panel.x_range, range);
  keys.take("y_range", panel.y_range, range);
  if (panel.x_range) keys.check("x_range", (*panel.x_range)[0] < (*panel.x_range)[1], range);
  if (panel.y_range) keys.check("y_range", (*panel.y_range)[0] < (*panel.y_range)[1], range);
  const std::string label = "a name without its unit, which is put behind it";
  keys.take("label", panel.label, label);
  keys.check("label", panel.label.find(" / ") == panel.label.npos, label);
  keys.take("exact", panel.exact, "true or false");
  keys.check("exact", !panel.exact || panel.x == "t", "false, unless x is t");
  return panel;
}

Study study_in(Keys& keys) {
  Study study;
  study.run = run_in(keys);
  keys.require("vary", "a key of scenes, such as \"grid.nodes\"");
  keys.take("vary", study.vary, "a key of scenes, such as \"grid.nodes\"");
  const bool is_number = std::ranges::any_of(scene_keys(), [&](const Key& key) {
    return key.path() == study.vary &&
           (study.vary == "grid.nodes" || std::holds_alternative<Member<double>>(key.access) ||
            std::holds_alternative<Member<int>>(key.access));
  });
  keys.check("vary", is_number, "a key of scenes that holds a number, such as \"grid.nodes\"");
  keys.require("values", finite_numbers);
  keys.take("values", study.values, finite_numbers);
  keys.check("values", !study.values.empty(), "at least one number");
  keys.require("quantities", columns_text);
  keys.take("quantities", study.quantities, columns_text);
  keys.check("quantities",
             are_columns(study.quantities) &&
                 study.quantities.size() <= render::style::curves.size(),
             fmt::format("up to {} {}", render::style::curves.size(), columns_text));
  keys.take("window", study.window, "two times to average between");
  keys.take("exact", study.exact, "a number for each of the quantities");
  keys.check("exact", study.exact.empty() || study.exact.size() == study.quantities.size(),
             "a number for each of the quantities");
  const std::string rows = "for each of the values a list of as many numbers as quantities; nan "
                           "where one is not known";
  keys.take("paper", study.paper, rows);
  keys.check("paper",
             study.paper.empty() || (study.paper.size() == study.values.size() &&
                                     std::ranges::all_of(study.paper,
                                                         [&](const auto& row) {
                                                           return row.size() ==
                                                                  study.quantities.size();
                                                         })),
             rows);
  return study;
}

PanelSpec panel_in(const toml::table& table, const std::string& source, int columns) {
  Keys keys(table, source, "[panel] ");
  PanelSpec panel;
  panel.span = columns;
  std::string kind = "membrane";
  const std::vector<std::string_view> kinds{"membrane", "plot", "table", "convergence"};
  const std::string allowed = fmt::format("\"{}\"", fmt::join(kinds, "\", \""));
  keys.take("kind", kind, allowed);
  keys.take("title", panel.title, "a text");
  keys.take("span", panel.span, fmt::format("1 to {}, the page's columns", columns));
  keys.check("span", panel.span >= 1 && panel.span <= columns,
             fmt::format("1 to {}, the page's columns", columns));
  keys.take("lettered", panel.lettered, "true or false");
  if (kind == "membrane")
    panel.content = membrane_in(keys, source);
  else if (kind == "plot")
    panel.content = plot_in(keys);
  else if (kind == "table")
    panel.content = TablePanel{study_in(keys)};
  else if (kind == "convergence")
    panel.content = ConvergencePanel{study_in(keys)};
  else
    keys.check("kind", false, allowed + suggestion(kind, kinds));
  keys.refuse_others();
  return panel;
}

} // namespace

FigureSpec parse_figure(std::string_view text, const std::string& source) {
  const toml::table table = parse_toml(text, source);
  FigureSpec figure;
  figure.name = std::filesystem::path(source).stem().string();
  Keys keys(table, source, "");
  keys.take("title", figure.title, "a text");
  keys.take("caption", figure.caption, "a text");
  keys.take("columns", figure.columns, "1 to 6");
  keys.check("columns", figure.columns >= 1 && figure.columns <= 6, "1 to 6");
  keys.table("panel");
  keys.refuse_others();
  const toml::array* list = table["panel"].as_array();
  if (!list || list->empty() || !list->is_homogeneous<toml::table>())
    refuse_scene(source +
                 ":1: there is no panel; allowed: sections [[panel]], each with the keys of "
                 "a panel");
  for (const toml::node& panel : *list)
    figure.panels.push_back(panel_in(*panel.as_table(), source, figure.columns));
  return figure;
}

FigureSpec read_figure(const std::filesystem::path& file) {
  return parse_figure(read_text(file), file.string());
}

RunSpec run_of(const Study& study, std::size_t value) {
  RunSpec run = study.run;
  run.set.push_back(fmt::format("{}={:g}", study.vary, study.values[value]));
  return run;
}

std::vector<RunSpec> runs_of(const FigureSpec& figure) {
  std::vector<RunSpec> runs;
  const auto need = [&](const RunSpec& run) {
    if (std::ranges::find(runs, run) == runs.end()) runs.push_back(run);
  };
  const auto need_study = [&](const Study& study) {
    for (std::size_t n = 0; n < study.values.size(); ++n) need(run_of(study, n));
  };
  for (const PanelSpec& panel : figure.panels) {
    if (const auto* membrane = std::get_if<MembranePanel>(&panel.content)) need(membrane->run);
    if (const auto* plot = std::get_if<PlotPanel>(&panel.content))
      std::ranges::for_each(plot->runs, need);
    if (const auto* table = std::get_if<TablePanel>(&panel.content)) need_study(table->study);
    if (const auto* order = std::get_if<ConvergencePanel>(&panel.content)) need_study(order->study);
  }
  return runs;
}

} // namespace lamella
