#pragma once
#include "grid/grid.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lamella {

/// A field and its gradient between the nodes, trilinear. Grid and values must outlive it.
class Sampler {
public:
  Sampler(const Grid& grid, const std::vector<double>& values) : grid_(grid), values_(values) {}

  double value(const Vec3& p) const {
    return interpolate(p, [&](int i, int j, int k) { return node(i, j, k); });
  }

  /// From fourth-order differences at the nodes.
  Vec3 gradient(const Vec3& p) const {
    Vec3 g;
    for (int a = 0; a < 3; ++a)
      g[a] = interpolate(p, [&](int i, int j, int k) { return difference(a, i, j, k); });
    return g;
  }

private:
  double node(int i, int j, int k) const {
    const auto& n = grid_.nodes;
    return values_[grid_.index(std::clamp(i, 0, n[0] - 1), std::clamp(j, 0, n[1] - 1),
                               std::clamp(k, 0, n[2] - 1))];
  }

  double difference(int axis, int i, int j, int k) const {
    const std::array<int, 3> d{axis == 0, axis == 1, axis == 2};
    const auto at = [&](int s) { return node(i + s * d[0], j + s * d[1], k + s * d[2]); };
    return (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * grid_.spacing);
  }

  /// Of a cell. Points on edges of the lattice, as those of contours, have two neighbours, and not
  /// six more of hardly any weight because their coordinates are rounded to floats.
  static constexpr double rounding = 1e-5;

  /// In [0, 1].
  static double snapped(double t) { return t < rounding ? 0 : t > 1 - rounding ? 1 : t; }

  template <class Node>
  double interpolate(const Vec3& p, Node&& node) const {
    std::array<int, 3> base;
    Vec3 t;
    for (int a = 0; a < 3; ++a) {
      const double x = (p[a] - grid_.origin(a)) / grid_.spacing;
      base[a] = std::clamp(int(std::floor(x)), 0, std::max(0, grid_.nodes[a] - 2));
      t[a] = snapped(x - base[a]);
    }
    double sum = 0;
    for (int c = 0; c < 8; ++c) {
      const int i = c & 1, j = c >> 1 & 1, k = c >> 2;
      const double weight = (i ? t[0] : 1 - t[0]) * (j ? t[1] : 1 - t[1]) * (k ? t[2] : 1 - t[2]);
      if (weight > 0) sum += weight * node(base[0] + i, base[1] + j, base[2] + k);
    }
    return sum;
  }

  const Grid& grid_;
  const std::vector<double>& values_;
};

} // namespace lamella
