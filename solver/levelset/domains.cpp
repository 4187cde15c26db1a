#include "levelset/domains.h"

#include <cmath>

namespace lamella {

std::vector<Domain> domains_of(const NarrowBand& band, std::span<const double> psi) {
  const Grid& grid = band.grid();
  const double h = grid.spacing, area_of_node = 0.5 * h * h; // about two nodes a squared spacing
  std::vector<char> seen(band.size(), 0);
  auto near = [&](int slot) { return slot >= 0 && std::abs(band.distance()[slot]) < h; };
  std::vector<Domain> domains;
  std::vector<int> front;
  for (std::size_t s = 0; s < band.size(); s++) {
    if (seen[s] || !near(int(s))) continue;
    Domain domain{psi[band.node()[s]] < 0, {}, 0};
    double count = 0;
    front = {int(s)};
    seen[s] = 1;
    while (!front.empty()) {
      const int at = front.back();
      front.pop_back();
      const Vec3 x = grid.position(band.node()[at]);
      for (int d = 0; d < 3; d++) domain.center[d] += x[d];
      count++;
      for_each_neighbour(grid, band.node()[at], [&](int node) {
        const int slot = band.slot(node);
        if (!near(slot) || seen[slot] || (psi[node] < 0) != domain.is_Ld) return;
        seen[slot] = 1;
        front.push_back(slot);
      });
    }
    for (double& c : domain.center) c /= count;
    domain.area = count * area_of_node;
    domains.push_back(domain);
  }
  return domains;
}

} // namespace lamella
