#pragma once
#include "dynamics/measures.h"
#include "render/studio.h"

#include <vector>

namespace lamella::render {

/// Energy over time, E / kappa against t kappa / (zeta L^4). With two phases or local stretch its
/// terms too, those that are not 0 throughout. The time axis is logarithmic when the
/// run spans decades of time and most of the energy goes in the first of them; the start, t = 0,
/// then stands left of the axis proper. Rows that are not finite are left out. `width` and the
/// height, 3/4 of it, in pixels. Throws RenderError when there is nothing to plot.
Picture draw_energy(Studio& studio, const std::vector<Measures>& history, double bending_modulus,
                    int width);

} // namespace lamella::render
