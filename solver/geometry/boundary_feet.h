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
