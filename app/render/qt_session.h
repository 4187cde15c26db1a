#pragma once

namespace lamella::render {

/// Qt without a display, for all that draws or starts processes with it; the first call begins it.
/// Call it from the main thread. Throws RenderError where there is no font.
void begin_qt();

} // namespace lamella::render
