#pragma once
#include "levelset/level_set.h"

#include <vtkPoints.h>

#include <span>
#include <vector>

namespace lamella {

/// The spline through nodal values.
LevelSet fitted(const Grid& grid, std::span<const double> values);

/// Geometry of the membrane {phi = 0} at points, in their order.
struct SplineGeometry {
  std::vector<float> normals; ///< x, y, z of each
  std::vector<double> KM, K;  ///< K_M = -2, K = 1 on the unit sphere
};

/// Moves points that are within a fraction of a spacing of {phi = 0} onto it, along the normal.
SplineGeometry move_onto(const LevelSet& phi, vtkPoints& points);

/// |grad phi| at points.
std::vector<double> slopes_at(const LevelSet& phi, vtkPoints& points);

} // namespace lamella
