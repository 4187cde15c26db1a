#pragma once
#include "grid/grid.h"

#include <span>

namespace lamella {

/// Connected components of {phi < 0} on the periodic lattice (neighbours along the axes).
int count_components(const Grid& grid, std::span<const double> phi);

/// Topology of the inside {phi < 0} on the lattice, exact whatever the curvatures do.
struct Topology {
  int components = 0; ///< connected parts of the inside
  int genus = 0;      ///< handles, summed over the components

  bool operator==(const Topology&) const = default;
};
Topology topology_of(const Grid& grid, std::span<const double> phi);

} // namespace lamella
