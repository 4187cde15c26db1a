#pragma once
#include "geometry/surface_geometry.h"
#include "levelset/extension.h"
#include "levelset/level_set.h"

#include <vector>

namespace lamella {

/// Lap_s K_M continued into the box, constant along normals, as a spline: its derivatives on the
/// membrane are of up to sixth order in phi.
///
/// (phi's own sixth derivatives are polygons between the nodes and err by h^2, which does not
/// average out: samples are nearest points of nodes, and where the membrane lies along a lattice
/// plane all of them have the same error. On a bumpy body at 64^3 that was 1.6e-3 of the work of
/// forces; with the field it is 4e-6.)
class LaplacianField {
public:
  LaplacianField(const Grid& grid, Fourier& fourier);

  /// From the samples of the band, their derivatives known. `extension`: prepared for them.
  void find(const LevelSet& phi, const NarrowBand& band, const SurfaceGeometry& surface,
            Extension& extension);
  const LevelSet& spline() const { return field_; }

private:
  Fourier& fourier_;
  LevelSet field_;
  std::vector<double> symbol_[3]; // of the spline, along each axis
  std::vector<double> values_, weights_;
};

/// The same once, of a membrane that is looked at and not moved.
LevelSet lap_KM_around(const LevelSet& phi, const NarrowBand& band, const SurfaceGeometry& surface);

} // namespace lamella
