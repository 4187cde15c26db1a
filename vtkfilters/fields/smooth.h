#pragma once
#include "grid/grid.h"

#include <vector>

namespace lamella {

/// Makes a level set nearly periodic as those of start shapes are: W tanh(phi / W), with W the
/// larger of 16 spacings and a quarter of the box. One that stays within W is left as it is.
void level_off(const Grid& grid, std::vector<double>& phi);

/// Blurs periodic nodal values by a Gaussian whose standard deviation is so many spacings.
void blur(const Grid& grid, double width, std::vector<double>& values);

/// A level set of slope about 1 from the share of the inside, 1 or 0 at the nodes: its edge is
/// smoothed over `width` spacings, and it is level beyond seven of them.
std::vector<double> from_share(const Grid& grid, double width, std::vector<double> share);

} // namespace lamella
