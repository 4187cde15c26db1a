#pragma once
#include "grid/grid.h"

#include <span>
#include <vector>

namespace lamella {

/// Nodes of an image, x fastest; the spacings need not be the same.
struct Lattice {
  std::array<int, 3> nodes{};
  Vec3 spacing{};
  Vec3 first{}; ///< place of the first node

  /// Spacings are the same but for rounding.
  bool is_even() const;
};

/// The grid of the smallest of the spacings whose nodes, from the first one on, lie between those
/// of the lattice.
Grid evened(const Lattice& lattice);

/// Nodal values on a wider lattice with so many nodes before the first: beyond the old ones their
/// last values, plus a slope times the number of nodes from there.
std::vector<double> widened(const std::vector<double>& values, const std::array<int, 3>& from,
                            const std::array<int, 3>& to, const std::array<int, 3>& before,
                            double slope = 0);

enum class Interpolation { linear, smooth }; ///< smooth: through the six nearest nodes

/// Nodal values on the evened grid. One axis after the other.
std::vector<double> resample(std::vector<double> values, const Lattice& lattice,
                             Interpolation interpolation);

/// Values at positions (in nodes) along one axis of an array, of so many nodes; `inner` values lie
/// between neighbours along it.
std::vector<double> interpolate_axis(const std::vector<double>& in, int nodes, std::size_t inner,
                                     std::span<const double> positions,
                                     Interpolation interpolation);

} // namespace lamella
