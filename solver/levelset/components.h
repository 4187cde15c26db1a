#pragma once
#include "grid/grid.h"

#include <span>
#include <vector>

namespace lamella {

/// The connected parts of the inside {phi < 0}, as topology_of() counts them, but for parts that
/// reach across the sides of the box. In the order of their first nodes.
struct ComponentMap {
  std::vector<int> of_node; ///< of each node of the grid; -1 outside
  std::vector<int> nodes;   ///< how many each component has
};
ComponentMap components_of(const Grid& grid, std::span<const double> phi);

} // namespace lamella
