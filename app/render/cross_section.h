#pragma once
#include "render/membrane_view.h"
#include "render/phases.h"

namespace lamella::render {

/// A line of the membrane in a cross-section, as (x, z), all in one part of it. Lines that end, do
/// so on the boundary of two phases, where another one begins.
struct Outline {
  Part part;
  std::vector<Vec2> points;
  bool closed;
};

/// The lines phi = 0 in the x-z plane through the centroid of the inside. Where that plane misses
/// the membrane, in the plane that cuts the largest area out of the inside.
std::vector<Outline> cross_section(const Surface& surface);

Extent extent_of(const std::vector<Outline>& lines);

} // namespace lamella::render
