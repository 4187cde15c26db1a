#pragma once
#include "grid/grid.h"

#include <span>

namespace lamella {

/// Connected components of {phi < 0} on the periodic lattice (neighbours along the axes).
int count_components(const Grid& grid, std::span<const double> phi);

} // namespace lamella
