#pragma once
#include "geometry/laplacian_field.h"
#include "geometry/surface_geometry.h"
#include "scene/shapes.h"

namespace lamella {

/// Values of a function at the nodes.
template <class Function>
std::vector<double> at_nodes(const Grid& grid, Function&& f) {
  std::vector<double> values(grid.size());
  for (std::size_t i = 0; i < values.size(); i++) values[i] = f(grid.position(i));
  return values;
}

/// A membrane as the solver sees it: level set, band, and samples with their geometry.
struct StartSurface {
  Grid grid;
  Fourier fourier;
  LevelSet phi;
  NarrowBand band;
  SurfaceGeometry geometry;

  StartSurface(const Shape& shape, const Grid& g) : StartSurface(initial_phi(shape, g), g) {}
  StartSurface(const std::vector<double>& nodal, const Grid& g)
      : grid(g), fourier(g), phi(g), band(g, 4.2) {
    std::copy(nodal.begin(), nodal.end(), phi.coefficients().begin());
    phi.fit(nodal, fourier);
    measure();
  }

  void measure() {
    phi.update_nodal();
    band.update(phi);
    geometry.sample(phi, band);
    geometry.jets(phi, band);
  }

  /// All that there is to know.
  void differentiate() {
    geometry.jets(phi, band, Derivatives::sixth);
    geometry.differentiate(lap_KM_around(phi, band, geometry));
  }
};

/// |grad phi| at the nearest points of the band's entries, 0 where unknown.
inline std::vector<double> grad_of_entries(const StartSurface& s) {
  std::vector<double> grad(s.band.size(), 0.0);
  for (std::size_t i = 0; i < s.geometry.entry().size(); i++)
    grad[s.geometry.entry()[i]] = s.geometry.grad()[i];
  return grad;
}

inline Shape sphere(double radius) {
  Shape s;
  s.kind = ShapeKind::sphere;
  s.radius = radius;
  return s;
}

inline Shape oblate(double semi_axis, double reduced_volume) {
  Shape s;
  s.kind = ShapeKind::oblate;
  s.semi_axis = semi_axis;
  s.reduced_volume = reduced_volume;
  return s;
}

inline Shape prolate(double semi_axis, double reduced_volume) {
  Shape s = oblate(semi_axis, reduced_volume);
  s.kind = ShapeKind::prolate;
  return s;
}

inline Shape ellipsoid(Vec3 semi_axes) {
  Shape s;
  s.kind = ShapeKind::ellipsoid;
  s.semi_axes = semi_axes;
  return s;
}

inline Shape torus(double ring_radius, double tube_radius) {
  Shape s;
  s.kind = ShapeKind::torus;
  s.ring_radius = ring_radius;
  s.tube_radius = tube_radius;
  return s;
}

/// The shape somewhere between the nodes, turned by an angle (degrees) about (1, 2, 3).
inline Shape moved(Shape s, Vec3 center, double angle) {
  s.center = center;
  s.rotation_axis = {1, 2, 3};
  s.rotation_angle = angle;
  return s;
}

} // namespace lamella
