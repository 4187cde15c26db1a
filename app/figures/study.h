#pragma once
#include "figures/figure_page.h"

namespace lamella {

/// What the runs of a study have come to; values are in the order of its quantities, and in the
/// units of pictures.
struct StudyResult {
  std::vector<double> exact;               ///< NaN where not known
  std::vector<std::vector<double>> values; ///< a row for every run
  std::vector<double> varied;              ///< spacings of the runs' grids, or values of the key
  std::vector<std::string> labels;         ///< of the runs: "64³", or the value
  render::Units units{};                   ///< of all of them
};

/// Throws StoreError, SceneError.
StudyResult evaluate(const Study& study, const RunFinder& find_run);

FigureTable table_of(const Study& study, const StudyResult& result);

/// The errors against the varied value, double logarithmic, with the fitted order
/// where errors fall.
render::Plot convergence_plot(const Study& study, const StudyResult& result);

/// The slope of a straight line through the logarithms of points; NaN for less than two.
double fitted_order(const std::vector<render::Vec2>& points);

} // namespace lamella
