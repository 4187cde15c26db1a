#pragma once
#include "levelset/narrow_band.h"

#include <span>
#include <vector>

namespace lamella {

/// Carries values from the membrane into the box.
class Extension {
public:
  explicit Extension(const Grid& grid);

  /// Notes which band entries have values of their own (known != 0) and where the others find
  /// theirs.
  void prepare(const NarrowBand& band, std::span<const char> known);

  /// Values of the other entries: linear interpolation, at the node's nearest point, of the known
  /// values around it; `fallback` where there are none.
  void complete(double fallback, std::span<double> value) const;

  /// Prepares plane(): values of the band where their weight is 1, and where it is less, and beyond
  /// the band, averages over ever larger cubes (a push-pull pyramid, cell centred, hence mirror
  /// symmetric). `weight` has to outlast the calls of plane().
  void fill(const NarrowBand& band, std::span<const double> value, std::span<const double> weight);
  /// With the band's taper for weights.
  void fill(const NarrowBand& band, std::span<const double> value) {
    fill(band, value, band.taper());
  }

  /// Extended values at the nodes of plane k.
  void plane(int k, double* out) const;

private:
  struct Level {
    int nodes[3];
    Array<double> value, weight;
    std::size_t row(int j, int k) const { return (std::size_t(k) * nodes[1] + j) * nodes[0]; }
  };
  /// An entry without a value of its own: weighted sum of the corners of the cell that its nearest
  /// point is in.
  struct Borrower {
    int entry, corner[8];
    double weight[8];
  };
  void push(const Level& fine, Level& coarse) const;
  void pull(const Level& coarse, Level& fine) const;

  Grid grid_;
  std::vector<Level> levels_; // 2, 4, 8 ... nodes of the grid a cell
  const NarrowBand* band_ = nullptr;
  std::span<const double> weight_;
  std::vector<double> tapered_;
  std::vector<Borrower> borrowers_;
};

} // namespace lamella
