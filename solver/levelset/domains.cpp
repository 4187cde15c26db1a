#include "levelset/domains.h"

#include <cmath>

namespace lamella {

DomainMap domains_of(const NarrowBand& band, std::span<const double> psi) {
  const Grid& grid = band.grid();
  const double h = grid.spacing, area_of_node = 0.5 * h * h; // about two nodes a squared spacing
  auto near = [&](int slot) { return slot >= 0 && std::abs(band.distance()[slot]) < h; };
  DomainMap map{{}, std::vector<int>(band.size(), -1)};
  std::vector<int>& of = map.of_entry;
  std::vector<int> front;
  for (std::size_t s = 0; s < band.size(); s++) {
    if (of[s] >= 0 || !near(int(s))) continue;
    Domain domain{psi[band.node()[s]] < 0, {}, 0};
    double count = 0;
    front = {int(s)};
    const int index = int(map.domains.size());
    of[s] = index;
    while (!front.empty()) {
      const int at = front.back();
      front.pop_back();
      const Vec3 x = grid.position(band.node()[at]);
      for (int d = 0; d < 3; d++) domain.center[d] += x[d];
      count++;
      for_each_neighbour(grid, band.node()[at], [&](int node) {
        const int slot = band.slot(node);
        if (!near(slot) || of[slot] >= 0 || (psi[node] < 0) != domain.is_Ld) return;
        of[slot] = index;
        front.push_back(slot);
      });
    }
    for (double& c : domain.center) c /= count;
    domain.area = count * area_of_node;
    map.domains.push_back(domain);
  }
  return map;
}

} // namespace lamella
