#include "fields/refine.h"

#include "parallel.h"

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

constexpr int taps = 6;

/// Lagrange weights of the nodes -2 .. 3 at position t.
std::array<double, taps> lagrange_weights(double t) {
  std::array<double, taps> weights;
  for (int i = 0; i < taps; ++i) {
    weights[i] = 1;
    for (int j = 0; j < taps; ++j)
      if (j != i) weights[i] *= (t - (j - 2)) / (i - j);
  }
  return weights;
}

/// Where a value of the refined lattice comes from, along one axis.
struct Stencil {
  int base; ///< the node before it
  std::array<double, taps> weights;
};

std::vector<Stencil> stencils(int nodes, int factor) {
  std::vector<Stencil> out;
  for (int i = 0; i < nodes * factor; ++i) {
    const double position = (i + 0.5) / factor - 0.5; // in old nodes; cells stay aligned
    const int base = int(std::floor(position));
    out.push_back({base, lagrange_weights(position - base)});
  }
  return out;
}

/// Refine along one axis; `inner` values lie between neighbours along it.
std::vector<double> refine_axis(const std::vector<double>& in, int nodes, std::size_t inner,
                                int factor) {
  const std::vector<Stencil> along = stencils(nodes, factor);
  std::vector<double> out(in.size() * factor);
  const std::size_t rows = out.size() / inner, grain = std::max<std::size_t>(1, 16384 / inner);
  parallel_for(rows, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      const auto& [base, weights] = along[r % along.size()];
      const std::size_t first = r / along.size() * nodes;
      std::array<const double*, taps> from;
      for (int k = 0; k < taps; ++k)
        from[k] = &in[(first + std::clamp(base - 2 + k, 0, nodes - 1)) * inner];
      double* row = &out[r * inner];
      for (std::size_t q = 0; q < inner; ++q) {
        double sum = 0;
        for (int k = 0; k < taps; ++k) sum += weights[k] * from[k][q];
        row[q] = sum;
      }
    }
  });
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
  return {.grid = kept,
          .time = frame.time,
          .phi = cropped(frame.phi, grid, cut),
          .psi = cropped(frame.psi, grid, cut),
          .c = cropped(frame.c, grid, cut)};
}

Frame refine(const Frame& frame, int factor) {
  Frame fine{
      .grid = frame.grid, .time = frame.time, .phi = frame.phi, .psi = frame.psi, .c = frame.c};
  std::size_t inner = 1;
  for (int axis = 0; axis < 3; ++axis) {
    for (std::vector<double>* values : {&fine.phi, &fine.psi, &fine.c})
      if (!values->empty()) *values = refine_axis(*values, frame.grid.nodes[axis], inner, factor);
    fine.grid.nodes[axis] *= factor;
    inner *= fine.grid.nodes[axis];
  }
  fine.grid.spacing /= factor;
  return fine;
}

} // namespace lamella
