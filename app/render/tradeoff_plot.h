#pragma once
#include "render/plot.h"
#include "render/render.h"

#include <span>

namespace lamella::render {

/// Relative error against wall time, a line for every grid; the Pareto front, full dots, is the
/// border to what no run achieves. Throws RenderError when there is nothing to plot.
Plot tradeoff_plot(std::span<const Trade> trades);

} // namespace lamella::render
