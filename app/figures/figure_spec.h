#pragma once
#include "render/strip.h"

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace lamella {

/// A run that a figure needs: a scene file or the name of a built-in one, and changes to it.
struct RunSpec {
  std::string scene;
  std::vector<std::string> set; ///< section.key=value
  bool operator==(const RunSpec&) const = default;
};

/// What must be the case at the last of a panel's times: a number, or a range. Names are those of
/// outcome_of().
using Expectations = std::map<std::string, std::array<double, 2>>;

/// Membranes of one run at several times.
struct MembranePanel {
  RunSpec run;
  std::vector<double> times; ///< the nearest stored states are taken; empty: start and end
  render::View view;
  Expectations expect;
};

/// As the only y of a plot: the energy of one run, and what it consists of.
constexpr std::string_view terms = "terms";

/// Columns of the histories of runs, of one dimension.
struct PlotPanel {
  std::vector<RunSpec> runs;
  std::vector<std::string> names; ///< of the runs, in the plot
  std::string x = "t";
  std::vector<std::string> y; ///< columns of history.csv, or `terms`
  bool log_x = false, log_y = false;
  std::optional<std::array<double, 2>> x_range, y_range; ///< none: of the data
  std::string label;  ///< of the y axis, without its unit; empty: that of the first column
  bool exact = false; ///< the exact solution of a built-in scene too
};

/// A scene with one key at several values, against what is exact.
struct Study {
  RunSpec run;
  std::string vary;                            ///< section.key
  std::vector<double> values;                  ///< as many runs
  std::vector<std::string> quantities;         ///< columns of history.csv
  std::optional<std::array<double, 2>> window; ///< times to average over; none: the end
  /// Of each quantity, in the units of pictures; empty: the exact solution that is built in.
  std::vector<double> exact;
  std::vector<std::vector<double>> paper; ///< a row for every value, NaN where not known
};
struct TablePanel {
  Study study;
};
struct ConvergencePanel {
  Study study;
};

struct PanelSpec {
  std::string title;
  int span = 1; ///< columns of the page
  bool lettered = true;
  std::variant<MembranePanel, PlotPanel, TablePanel, ConvergencePanel> content;
};

/// A page. docs/figures.md describes the format.
struct FigureSpec {
  std::string name; ///< of its files
  std::string title, caption;
  int columns = 1;
  std::vector<PanelSpec> panels;
};

/// Read a figure's file, or its text; `source` stands for the file in messages. Throw SceneError:
///   file:line: [panel] key: what is wrong; allowed: ...; did you mean "..."?
FigureSpec read_figure(const std::filesystem::path& file);
FigureSpec parse_figure(std::string_view text, const std::string& source);

/// A figure of data/figures, compiled in.
struct BuiltinFigure {
  std::string_view name, title, text;
};
/// In the order of the paper.
std::span<const BuiltinFigure> builtin_figures();

/// One run of a study.
RunSpec run_of(const Study& study, std::size_t value);

/// All runs that a figure needs, each once.
std::vector<RunSpec> runs_of(const FigureSpec& figure);

} // namespace lamella
