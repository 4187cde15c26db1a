#include "grid/grid.h"

#include <vector>

namespace lamella {

void shift(const Grid& grid, const std::array<int, 3>& cells, std::span<double> values) {
  const std::vector<double> old(values.begin(), values.end());
  auto from = [&](int axis, int i) {
    const int n = grid.nodes[axis];
    return ((i + cells[axis]) % n + n) % n;
  };
  std::size_t to = 0;
  for (int k = 0; k < grid.nz(); k++)
    for (int j = 0; j < grid.ny(); j++)
      for (int i = 0; i < grid.nx(); i++)
        values[to++] = old[grid.index(from(0, i), from(1, j), from(2, k))];
}

} // namespace lamella
