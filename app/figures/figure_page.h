#pragma once
#include "figures/figure_spec.h"
#include "render/block.h"
#include "render/run_pictures.h"

#include <functional>
#include <string>
#include <vector>

namespace lamella {

/// The folder in which a run that a figure needs is stored.
using RunFinder = std::function<std::filesystem::path(const RunSpec&)>;

/// A table of a page, in its three forms.
struct FigureTable {
  std::vector<std::string> names, units; ///< of the columns
  render::TableCells rows;

  render::TableCells cells() const; ///< two rows of names and units, then the others
  std::string csv() const, markdown() const;

private:
  std::vector<std::string> titles() const; ///< names with units
};

/// A figure ready to be written.
struct FigurePage {
  render::Sheet sheet;
  std::vector<FigureTable> tables;
  std::vector<std::string> surprises; ///< outcomes that are not as the figure's file expects
};

/// A plot of a page, in the units of pictures. Throws as draw_figure does.
render::Plot plot_of(const PlotPanel& panel, const RunFinder& find_run);

/// Throws RenderError, StoreError, and SceneError where the figure asks for what its runs do not
/// have.
FigurePage draw_figure(const FigureSpec& figure, const RunFinder& find_run, render::Camera camera);

} // namespace lamella
