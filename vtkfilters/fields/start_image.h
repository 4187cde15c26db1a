#pragma once
#include "fields/image.h"
#include "fields/resample.h"
#include "scene/scene.h"

class vtkInformation;

namespace lamella {

/// A grid around a centre.
struct ImagePlace {
  Grid grid;
  Vec3 center{};
};
/// The evened lattice.
ImagePlace place_of(const Lattice& lattice);

/// Where an image to come will be, from what is announced of it. Throws InputError where nothing
/// is.
ImagePlace announced_place(vtkInformation& info);

/// That of the solver around an image: as many more nodes along each axis as make a multiple of 8.
/// Throws InputError for more than it takes.
ImagePlace solver_place(const ImagePlace& image);

/// What a simulation starts from: the same membrane on such nodes, with a phi of slope about 1 that
/// levels off away from it. What was done to the fields is added to the remark.
ImageVesicle start_of(ImageVesicle vesicle);

/// The scene that starts from such fields: their grid, and phases where they have them.
Scene with_start(Scene scene, const Grid& grid, bool has_phases);

} // namespace lamella
