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
  std::vector<float> normals;        ///< x, y, z of each
  std::vector<double> KM, K, lap_KM; ///< K_M = -2, K = 1 on the unit sphere; Lap_s K_M
};

/// Moves points that are within a fraction of a spacing of {phi = 0} onto it, along the normal.
/// Leaves lap_KM empty unless it is asked for.
SplineGeometry move_onto(const LevelSet& phi, vtkPoints& points, bool with_lap_KM);

/// |grad phi| at points.
std::vector<double> slopes_at(const LevelSet& phi, vtkPoints& points);

} // namespace lamella
