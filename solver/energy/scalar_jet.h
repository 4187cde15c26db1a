#pragma once
#include "energy/surface_jet.h"
#include "geometry/surface_geometry.h"
#include "levelset/taylor.h"

#include <Eigen/Core>

#include <vector>

namespace lamella {

/// B at a sample, where it is known.
Eigen::Matrix3d curvature_tensor(const SurfaceGeometry& surface, std::size_t sample);

/// The jet along the membrane of a function in space, at a sample. What needs the curvature tensor
/// is 0 where that is not known.
SurfaceJet<double> jet_along(const Taylor& f, const SurfaceGeometry& surface, std::size_t sample);

/// The same at all samples.
void find_jets(const LevelSet& f, const SurfaceGeometry& surface,
               std::vector<SurfaceJet<double>>& jets);

} // namespace lamella
