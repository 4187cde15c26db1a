#pragma once
#include "grid/memory.h"
#include "levelset/level_set.h"

#include <span>
#include <vector>

namespace lamella {

/// The nodes near the membrane, each with the nearest point of the membrane.
///
/// Nodes are in ascending order of their grid index, whatever the number of threads.
class NarrowBand {
public:
  /// half_width in grid spacings.
  NarrowBand(const Grid& grid, double half_width);

  /// Follow the level set (nodal values up to date): one Newton step from the previous nearest
  /// point where there is one, a breadth-first march from the sign changes of phi where there is
  /// none.
  void update(const LevelSet& phi);

  /// Forget everything: the next update() starts anew.
  void clear();

  /// All that update() knows of the band before: nodes in ascending order and their nearest points.
  struct State {
    std::vector<int> node;
    Array<double> x, y, z; ///< of the nearest points
  };
  void store(State& state) const;
  void restore(const State& state);

  const Grid& grid() const { return grid_; }
  std::size_t size() const { return node_.size(); }
  std::span<const int> node() const { return node_; }
  /// First band index of plane k; plane_begin(nz) is size().
  int plane_begin(int k) const { return plane_begin_[k]; }
  /// Band index of a grid node, -1 outside the band.
  int slot(std::size_t node) const { return slot_[node]; }

  /// The nodes' own positions, by coordinate.
  ConstPoints positions() const { return {x_.data(), y_.data(), z_.data()}; }
  /// Nearest points, by coordinate.
  ConstPoints points() const { return {px_.data(), py_.data(), pz_.data()}; }
  Points points() { return {px_.data(), py_.data(), pz_.data()}; }
  /// |x - p|, negative inside; lengths.
  std::span<const double> distance() const { return distance_; }
  /// The same between the nodes, in [-limit, limit]: trilinear, exact for flat sheets. Points off
  /// the band count as deep inside.
  double distance_at(const Vec3& x, double limit) const;

  /// 1 on the membrane and near it, falling smoothly to 0 at the edge of the band.
  std::span<const double> taper() const { return taper_; }

private:
  struct Entry {
    int node;
    double p[3], distance;
  };

  void refresh(const LevelSet& phi);
  void repair(const LevelSet& phi);
  void grow(const LevelSet& phi);
  void solve(const LevelSet& phi, std::vector<Entry>& entries, int iterations) const;
  std::vector<Entry> seeds(const LevelSet& phi) const;
  std::vector<Entry> neighbours(std::span<const Entry> frontier) const;
  void rebuild(std::vector<Entry>& added);
  void fill(std::span<const Entry> entries);
  void finish(const LevelSet& phi);

  Grid grid_;
  double half_width_;
  std::vector<int> node_, slot_, plane_begin_;
  Array<double> x_, y_, z_, px_, py_, pz_, distance_, taper_;
};

} // namespace lamella
