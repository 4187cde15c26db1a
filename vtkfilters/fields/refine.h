#pragma once
#include "store/frame.h"

namespace lamella {

/// The fields of a frame cut to the smallest box, centred like the grid, that holds the inside (phi
/// < 0) and a margin (a length) around it; to the whole box if that does not fit.
Frame crop(const Frame& frame, double margin);

/// The fields of a frame on a lattice finer by a whole factor over the same box. Fifth-order
/// polynomials through the six nearest nodes along each axis, one axis after the other.
Frame refine(const Frame& frame, int factor);

} // namespace lamella
