#pragma once
#include "store/folder.h"
#include "store/frame.h"

namespace lamella {

/// write_frame() to a place that is not a path: in a folder that is held open.
void write_frame(const Place& place, const Frame& frame);

} // namespace lamella
