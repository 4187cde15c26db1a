#pragma once
#include "store/frame.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace lamella {

/// Triangles of phi = 0 on the lattice of a frame, linear between its nodes: points on the edges of
/// the lattice, each there once, every edge of a triangle shared by two, wound around the outward
/// direction.
vtkSmartPointer<vtkPolyData> contour(const Frame& frame);

/// Adds the unit outward normals of such a mesh, from the gradient of phi.
void add_normals(vtkPolyData& mesh, const Frame& frame);

/// Adds psi and c where the frame has them; psi are then the scalars.
void add_fields(vtkPolyData& mesh, const Frame& frame);

} // namespace lamella
