#pragma once
#include "fields/image.h"
#include "scene/scene.h"

namespace lamella {

/// What a simulation starts from: the same membrane, with a phi of slope about 1 that levels off
/// away from it. Throws InputError for a grid that the solver has no use for.
Frame start_frame(const ImageVesicle& vesicle);

/// The scene that starts from such a frame: its grid, and phases where it has them.
Scene with_start(Scene scene, const Frame& frame);

} // namespace lamella
