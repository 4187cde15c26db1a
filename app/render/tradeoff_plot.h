#pragma once
#include "render/render.h"
#include "render/studio.h"

#include <span>

namespace lamella::render {

/// Error against wall time, both logarithmic: a line for each grid, in order of the trades, full
/// dots for the Pareto front and the border of what it leaves out. Trades without a positive error
/// are left out. `width` and the height, 3/4 of it, in pixels. Throws RenderError when there is
/// nothing to plot.
Picture draw_tradeoff(Studio& studio, std::span<const Trade> trades, int width);

} // namespace lamella::render
