#pragma once
#include "fields/resample.h"

#include <string>
#include <vector>

namespace lamella {

/// The voxels of an image that are inside a membrane.
struct Mask {
  Lattice lattice;
  std::vector<char> inside;
  std::array<int, 3> before{}; ///< voxels that were put before those of the image
};

/// The voxels with a value, with room around them. Throws InputError where there are none, or where
/// they are most of the sides of the image; `inverted` then says what to do.
Mask mask_where(const std::vector<double>& values, double value, const Lattice& lattice,
                const std::string& inverted, std::string& remark);

/// The level set of a mask on a grid, the evened lattice: the edge is smoothed over two of the
/// largest voxels, and each part keeps its volume. Parts and cavities too small for that go, and so
/// do all cavities where they are to be filled; the remark says so. Throws InputError where nothing
/// is left.
std::vector<double> phi_of(Mask mask, bool fill_cavities, const Grid& grid, std::string& remark);

} // namespace lamella
