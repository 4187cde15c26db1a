#pragma once
#include "fields/resample.h"

#include <vtkImageData.h>

#include <vector>

namespace lamella {

/// Where the values of an image lie: a lattice along x, y and z, whichever way its own axes go.
class ImageLattice {
public:
  /// Of points, or of the middles of cells. Throws InputError for an image that is empty or flat,
  /// or whose axes are not those of space, up to order, sign and rounding.
  ImageLattice(vtkImageData& image, bool of_cells);

  const Lattice& lattice() const { return lattice_; }

  /// Values of the image in the order of the lattice, x fastest.
  std::vector<double> in_order(std::vector<double> values) const;

private:
  Lattice lattice_;
  std::array<int, 3> axis_{};     ///< of the image, along x, y, z
  std::array<bool, 3> flipped_{}; ///< whether it runs the other way
};

} // namespace lamella
