#pragma once
#include "dynamics/measures.h"
#include "render/plot.h"
#include "render/units.h"

#include <vector>

namespace lamella::render {

/// Energy over time. Where it has several terms, these too, those that are not 0 throughout. The
/// time axis is logarithmic when the run spans decades of time and most of the energy goes in the
/// first of them. Rows that are not finite are left out. Throws RenderError when there is nothing
/// to plot.
Plot energy_plot(const std::vector<Measures>& history, const Units& units);

} // namespace lamella::render
