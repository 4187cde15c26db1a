#pragma once
#include "render/membrane_view.h"
#include "render/phases.h"

namespace lamella::render {

/// A line of the membrane in a cross-section, all in one part of it. Lines that end, do
/// so on the boundary of two phases, where another one begins.
struct Outline {
  Part part;
  std::vector<Vec2> points;
  bool closed;
};

/// The lines in which the plane through the centroid of the membrane, upright and across the line
/// of sight from `azimuth` (degrees, see Viewpoint), cuts it: at 0 the x-z plane. Points are
/// (right, up). Where that plane misses the membrane, the plane beside it that cuts the most of it.
std::vector<Outline> cross_section(const Surface& surface, double azimuth = 0);

Extent extent_of(const std::vector<Outline>& lines);

} // namespace lamella::render
