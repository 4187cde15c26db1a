#include "fields/resample.h"

#include "parallel.h"

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

constexpr double equal_spacings = 1e-6; // relative
constexpr int taps = 6;

using Weights = std::array<double, taps>;

/// Lagrange weights of the nodes -2 .. 3 at position t.
Weights lagrange_weights(double t) {
  Weights weights;
  for (int i = 0; i < taps; ++i) {
    weights[i] = 1;
    for (int j = 0; j < taps; ++j)
      if (j != i) weights[i] *= (t - (j - 2)) / (i - j);
  }
  return weights;
}

Weights linear_weights(double t) { return {0, 0, 1 - t, t, 0, 0}; }

/// Where a value comes from, along one axis.
struct Stencil {
  int base; ///< the node before it
  Weights weights;
};

} // namespace

bool Lattice::is_even() const {
  return std::ranges::all_of(
      spacing, [&](double h) { return std::abs(h / spacing[0] - 1) < equal_spacings; });
}

Grid evened(const Lattice& lattice) {
  if (lattice.is_even()) return {lattice.nodes, lattice.spacing[0]};
  Grid grid{{}, *std::ranges::min_element(lattice.spacing)};
  for (int a = 0; a < 3; ++a) {
    const double length = (lattice.nodes[a] - 1) * lattice.spacing[a] / grid.spacing;
    grid.nodes[a] = int(std::min(1e9, std::floor(length * (1 + equal_spacings)))) + 1;
  }
  return grid;
}

std::vector<double> widened(const std::vector<double>& values, const std::array<int, 3>& from,
                            const std::array<int, 3>& to, const std::array<int, 3>& before,
                            double slope) {
  std::vector<double> out;
  if (values.empty()) return out;
  out.reserve(std::size_t(to[0]) * to[1] * to[2]);
  for (int k = 0; k < to[2]; ++k)
    for (int j = 0; j < to[1]; ++j)
      for (int i = 0; i < to[0]; ++i) {
        const std::array<int, 3> at{i - before[0], j - before[1], k - before[2]};
        std::array<int, 3> nearest, off;
        for (int a = 0; a < 3; ++a) {
          nearest[a] = std::clamp(at[a], 0, from[a] - 1);
          off[a] = at[a] - nearest[a];
        }
        const std::size_t n =
            (std::size_t(nearest[2]) * from[1] + nearest[1]) * from[0] + nearest[0];
        out.push_back(values[n] + slope * std::hypot(off[0], off[1], off[2]));
      }
  return out;
}

std::vector<double> resample(std::vector<double> values, const Lattice& lattice,
                             Interpolation interpolation) {
  if (lattice.is_even() || values.empty()) return values;
  const Grid grid = evened(lattice);
  std::size_t inner = 1;
  for (int a = 0; a < 3; ++a) {
    std::vector<double> positions;
    for (int i = 0; i < grid.nodes[a]; ++i)
      positions.push_back(i * grid.spacing / lattice.spacing[a]);
    values = interpolate_axis(values, lattice.nodes[a], inner, positions, interpolation);
    inner *= positions.size();
  }
  return values;
}

std::vector<double> interpolate_axis(const std::vector<double>& in, int nodes, std::size_t inner,
                                     std::span<const double> positions,
                                     Interpolation interpolation) {
  std::vector<Stencil> along;
  for (const double position : positions) {
    const int base = int(std::floor(position));
    const double t = position - base;
    along.push_back(
        {base, interpolation == Interpolation::smooth ? lagrange_weights(t) : linear_weights(t)});
  }
  std::vector<double> out(in.size() / nodes * along.size());
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

} // namespace lamella
