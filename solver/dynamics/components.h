#pragma once
#include "dynamics/surface_integrals.h"
#include "geometry/surface_geometry.h"
#include "levelset/components.h"
#include "levelset/narrow_band.h"

#include <array>
#include <span>
#include <vector>

namespace lamella {

/// How the vesicles of one time come from those of another: those of the same group gave all they
/// held to those of the same group.
struct Succession {
  std::vector<int> before, after; ///< the group of each vesicle
  /// A group is one vesicle that stays one, as all are where nothing happens.
  bool is_unchanged(int group) const;
  bool is_unchanged() const;
};

/// The vesicles that a membrane consists of: connected parts of the inside, each with all of its
/// membrane, inner sheets too. Those too small for the grid to hold on to count to the vesicle that
/// they came off.
///
/// A vesicle keeps its number while others part or meet. Of one that parts the largest piece keeps
/// it, the others come last; several that meet take the least of theirs.
class Components {
public:
  /// `separate` false: all that there is counts as one.
  Components(const Grid& grid, bool separate) : grid_(grid), separate_(separate) {}

  int count() const { return count_; }

  /// Finds the vesicles at nodal values of phi. What became of those of the last settle() is in
  /// succession().
  void follow(std::span<const double> phi);
  const Succession& succession() const { return succession_; }
  void settle();

  /// Finds to which vesicle the band's entries belong, as of the last follow().
  void find_entries(const NarrowBand& band);
  /// The same of the samples, of which entries and normals are known.
  void find_samples(const SurfaceGeometry& surface);

  int of_entry(std::size_t entry) const { return count_ == 1 ? 0 : of_entry_[entry]; }
  int of_sample(std::size_t sample) const { return count_ == 1 ? 0 : of_sample_[sample]; }
  Samples samples(int component) const;
  /// At a point of the membrane with its normal.
  int at(const Vec3& point, const Vec3& normal) const;

  /// Of each node as of the last settle(), -1 outside; empty where there is one vesicle.
  const std::vector<int>& settled() const { return settled_; }
  /// Goes back to what was settled() before.
  void restore(std::vector<int> settled);
  /// The box moved by so many cells.
  void shift(const std::array<int, 3>& cells);

private:
  struct Piece {
    int group, nodes;
  };
  std::vector<int> number(std::vector<Piece>& pieces);

  Grid grid_;
  bool separate_;
  int count_ = 1, settled_count_ = 1;
  std::vector<int> of_node_, settled_; // empty: one vesicle
  Succession succession_{{0}, {0}};
  std::vector<int> of_entry_, of_sample_;
  std::vector<std::vector<int>> samples_;
};

} // namespace lamella
