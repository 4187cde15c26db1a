#pragma once
#include "figures/figure_page.h"

namespace lamella {

/// What the runs of a study have come to; values are in the order of its quantities.
struct StudyResult {
  std::vector<double> exact;               ///< NaN where not known
  std::vector<std::vector<double>> values; ///< a row for every run
  std::vector<double> spacings;            ///< of the runs' grids
  std::vector<std::string> labels;         ///< of the runs: "64³", or the value
};

/// Throws StoreError, SceneError.
StudyResult evaluate(const Study& study, const RunFinder& find_run);

FigureTable table_of(const Study& study, const StudyResult& result);

/// The errors against the varied value, double logarithmic, with the fitted order
/// where errors fall.
render::Plot convergence_plot(const Study& study, const StudyResult& result);

/// The slope of a straight line through the logarithms of points; NaN for less than two.
double fitted_order(const std::vector<render::Vec2>& points);

/// How a column of history.csv is written, and its unit: "*P*" and "*κ*/*L*³".
struct Notation {
  std::string symbol, unit;
  /// "*P* / (*κ*/*L*³)"
  std::string title() const;
};
Notation notation_of(const std::string& column);

} // namespace lamella
