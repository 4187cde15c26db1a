#pragma once
#include "dynamics/carried_field.h"
#include "scene/scene.h"
#include "store/frame.h"

#include <vector>

namespace lamella {

/// A scene's material fields as a frame has them, at the samples of its membrane. Throws InputError
/// where one is missing. The transform has to outlast them.
std::vector<CarriedField> material_fields(const Scene& scene, const Frame& frame,
                                          const SurfaceGeometry& surface, Fourier& fourier);

} // namespace lamella
