#include "fields/refine.h"

#include "fields/resample.h"

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

/// Positions of the refined nodes, in old ones; cells stay aligned.
std::vector<double> positions(int nodes, int factor) {
  std::vector<double> out;
  for (int i = 0; i < nodes * factor; ++i) out.push_back((i + 0.5) / factor - 0.5);
  return out;
}

/// `values` of a grid at the nodes that are left when so many layers are dropped at both ends.
std::vector<double> cropped(const std::vector<double>& values, const Grid& grid,
                            const std::array<int, 3>& cut) {
  std::vector<double> out;
  if (values.empty()) return out;
  for (int k = cut[2]; k < grid.nz() - cut[2]; ++k)
    for (int j = cut[1]; j < grid.ny() - cut[1]; ++j) {
      const auto row = values.begin() + grid.index(0, j, k);
      out.insert(out.end(), row + cut[0], row + grid.nx() - cut[0]);
    }
  return out;
}

} // namespace

Frame crop(const Frame& frame, double margin) {
  const Grid& grid = frame.grid;
  std::array<int, 3> cut; // layers to drop at both ends
  for (int a = 0; a < 3; ++a) cut[a] = grid.nodes[a] / 2;
  for (int k = 0; k < grid.nz(); ++k)
    for (int j = 0; j < grid.ny(); ++j)
      for (int i = 0; i < grid.nx(); ++i) {
        if (!(frame.phi[grid.index(i, j, k)] < 0)) continue;
        const std::array<int, 3> at{i, j, k};
        for (int a = 0; a < 3; ++a) cut[a] = std::min({cut[a], at[a], grid.nodes[a] - 1 - at[a]});
      }
  const int layers = int(std::ceil(margin / grid.spacing));
  Grid kept = grid;
  for (int a = 0; a < 3; ++a) {
    cut[a] = std::max(0, cut[a] - layers);
    kept.nodes[a] -= 2 * cut[a];
  }
  Frame out{.grid = kept, .time = frame.time, .phi = cropped(frame.phi, grid, cut)};
  for (const auto& [name, values] : frame.fields) out.fields[name] = cropped(values, grid, cut);
  return out;
}

Frame refine(const Frame& frame, int factor) {
  Frame fine{.grid = frame.grid, .time = frame.time, .phi = frame.phi, .fields = frame.fields};
  std::size_t inner = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const int nodes = frame.grid.nodes[axis];
    const std::vector<double> at = positions(nodes, factor);
    const auto interpolate = [&](std::vector<double>& values) {
      values = interpolate_axis(values, nodes, inner, at, Interpolation::smooth);
    };
    interpolate(fine.phi);
    for (auto& [name, values] : fine.fields) interpolate(values);
    fine.grid.nodes[axis] *= factor;
    inner *= fine.grid.nodes[axis];
  }
  fine.grid.spacing /= factor;
  return fine;
}

} // namespace lamella
