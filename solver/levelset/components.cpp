#include "levelset/components.h"

namespace lamella {

ComponentMap components_of(const Grid& grid, std::span<const double> phi) {
  ComponentMap map{std::vector<int>(grid.size(), -1), {}};
  std::vector<int> front;
  for (std::size_t first = 0; first < grid.size(); first++) {
    if (map.of_node[first] >= 0 || phi[first] >= 0) continue;
    const int index = int(map.nodes.size());
    int& count = map.nodes.emplace_back(0);
    front = {int(first)};
    map.of_node[first] = index;
    while (!front.empty()) {
      const int at = front.back();
      front.pop_back();
      count++;
      for_each_neighbour(grid, at, [&](int node) {
        if (map.of_node[node] >= 0 || phi[node] >= 0) return;
        map.of_node[node] = index;
        front.push_back(node);
      });
    }
  }
  return map;
}

} // namespace lamella
