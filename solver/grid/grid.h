#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace lamella {

using Vec3 = std::array<double, 3>;

/// A periodic box of equally spaced nodes, centred on the origin.
///
/// Nodes sit at cell centres, x_i = -nodes h / 2 + (i + 1/2) h, so that the lattice is mirror
/// symmetric about the centre of the box: a symmetric start stays symmetric. Arrays over the grid
/// are ordered with x fastest, index = (k ny + j) nx + i.
struct Grid {
  std::array<int, 3> nodes{}; ///< along x, y, z
  double spacing = 0;         ///< h, the same along all axes

  static Grid cube(int nodes_per_side, double half_width) {
    return {{nodes_per_side, nodes_per_side, nodes_per_side}, 2 * half_width / nodes_per_side};
  }

  int nx() const { return nodes[0]; }
  int ny() const { return nodes[1]; }
  int nz() const { return nodes[2]; }
  std::size_t size() const { return std::size_t(nx()) * ny() * nz(); }
  std::size_t index(int i, int j, int k) const { return (std::size_t(k) * ny() + j) * nx() + i; }

  double length(int axis) const { return nodes[axis] * spacing; }
  /// Position of node 0 along an axis.
  double origin(int axis) const { return -0.5 * length(axis) + 0.5 * spacing; }
  double coordinate(int axis, int i) const { return origin(axis) + i * spacing; }
  Vec3 position(std::size_t index) const {
    const int i = int(index % nx()), j = int(index / nx() % ny()), k = int(index / nx() / ny());
    return {coordinate(0, i), coordinate(1, j), coordinate(2, k)};
  }
  /// The node next to a point; on a side of the box for points beyond it.
  std::size_t nearest(const Vec3& point) const {
    int at[3];
    for (int d = 0; d < 3; d++)
      at[d] = std::clamp(int(std::lround((point[d] - origin(d)) / spacing)), 0, nodes[d] - 1);
    return index(at[0], at[1], at[2]);
  }

  bool operator==(const Grid&) const = default;
};

/// f(neighbour) for the up to six neighbours of a node along the axes; those beyond a side of the
/// box do not count.
template <class F>
void for_each_neighbour(const Grid& grid, int node, F&& f) {
  const int stride[3] = {1, grid.nx(), grid.nx() * grid.ny()};
  for (int d = 0; d < 3; d++) {
    const int at = node / stride[d] % grid.nodes[d];
    if (at > 0) f(node - stride[d]);
    if (at + 1 < grid.nodes[d]) f(node + stride[d]);
  }
}

/// Moves the box under periodic nodal values: the value at node i becomes that at i + cells.
void shift(const Grid& grid, const std::array<int, 3>& cells, std::span<double> values);

} // namespace lamella
