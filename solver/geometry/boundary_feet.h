#pragma once
#include "geometry/phase_boundary.h"

#include <span>
#include <vector>

namespace lamella {

/// The nearest point of the phase boundary for points on the membrane near it.
class BoundaryFeet {
public:
  struct Foot {
    int at = -1, next = -1; ///< the points of the boundary that it lies between; -1: none near
    double share = 0;       ///< of `next`
    double distance = 0;    ///< signed, along the membrane; positive in P+

    bool exists() const { return at >= 0; }
    /// A quantity known at the points of the boundary, where this foot is.
    template <class Values>
    double value(const Values& of_points) const {
      return (1 - share) * of_points[at] + share * of_points[next];
    }
    /// The same by cubics, which take the points before and after these two too.
    template <class Values>
    double smooth_value(const Values& of_points, const PhaseBoundary& boundary) const {
      const auto [before, after] = boundary.neighbours(at);
      const int back = next == after ? before : after;
      const auto [first, second] = boundary.neighbours(next);
      const int beyond = first == at ? second : first;
      if (back == at || beyond == next) return value(of_points); // the end of an open piece
      const double u = share, v = 1 - u;
      return v * (1 + u) * (1 + v) / 2 * of_points[at] +
             u * (1 + u) * (1 + v) / 2 * of_points[next] -
             u * v * ((1 + v) / 6 * of_points[back] + (1 + u) / 6 * of_points[beyond]);
    }
  };

  /// Feet of the nearest points of the band's nodes, as far as they are nearer than `reach`.
  void find(const PhaseBoundary& boundary, const LevelSet& phi, const NarrowBand& band,
            double reach);

  const Foot& operator[](std::size_t i) const { return feet_[i]; }
  std::size_t size() const { return feet_.size(); }

private:
  std::vector<Foot> feet_;
};

} // namespace lamella
