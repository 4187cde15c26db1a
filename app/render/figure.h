#pragma once
#include "render/studio.h"
#include "render/surface.h"

namespace lamella::render {

/// The start and the end of a run: the membrane in 3-D and its x-z cross-section, all at the same
/// scale, with a scale bar. The section stands below the 3-D view, or beside it for shapes taller
/// than wide. `width` in pixels; the height follows from the shapes. Throws RenderError.
Picture draw_figure(Studio& studio, const Surface& start, const Surface& end, int width);

/// One membrane alone, fitted into a picture, with the time and a scale bar. Throws RenderError.
Picture draw_membrane(Studio& studio, const Surface& surface, int width, int height);

} // namespace lamella::render
