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
  render::TableCells cells;
  std::string csv() const, markdown() const;
};

/// A figure ready to be written.
struct FigurePage {
  render::Sheet sheet;
  std::vector<FigureTable> tables;
  std::vector<std::string> surprises; ///< outcomes that are not as the figure's file expects
};

/// Throws RenderError, StoreError, and SceneError where the figure asks for what its runs do not
/// have.
FigurePage draw_figure(const FigureSpec& figure, const RunFinder& find_run, render::Camera camera);

} // namespace lamella
