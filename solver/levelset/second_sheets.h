#pragma once
#include "levelset/narrow_band.h"

#include <vector>

namespace lamella {

/// Nodes within reach of a sheet of the membrane that is not their nearest, each with the point of
/// that sheet from which the node lies along the normal.
///
/// Quadrature sums, sheet by sheet, over the nodes of a layer along it. Where another sheet is
/// near, part of that layer lies beyond the middle of the gap, or even beyond the other sheet, and
/// the band knows those nodes for the other sheet only.
class SecondSheets {
public:
  /// Pairs of the level set whose signed distance (x - p).N is within [nearest, furthest]
  /// (lengths). Without gaps narrower than that there are none, and looking for them costs little.
  void find(const LevelSet& phi, const NarrowBand& band, double nearest, double furthest);

  std::size_t size() const { return node_.size(); }
  ConstPoints positions() const { return {x_[0].data(), x_[1].data(), x_[2].data()}; }
  ConstPoints points() const { return {p_[0].data(), p_[1].data(), p_[2].data()}; }

private:
  struct Pair {
    int node;
    Vec3 p;
  };
  std::vector<Pair> seeds(const NarrowBand& band, double nearest, double furthest) const;
  std::vector<Pair> accept(const LevelSet& phi, const NarrowBand& band,
                           std::vector<Pair> candidates, double nearest, double furthest);
  bool is_known(const NarrowBand& band, const Pair& pair) const;

  std::vector<int> node_;
  std::vector<double> x_[3], p_[3];
  std::vector<std::vector<int>> at_node_; // pairs by node modulo the number of lists
};

} // namespace lamella
