#pragma once
#include "render/membrane_view.h"

namespace lamella::render {

/// The lines phi = 0 in the x-z plane through the centroid of the inside; each closed, as (x, z).
/// Where that plane misses the membrane, in the plane that cuts the largest area out of the inside.
std::vector<std::vector<Vec2>> cross_section(const Surface& surface);

Extent extent_of(const std::vector<std::vector<Vec2>>& lines);

} // namespace lamella::render
