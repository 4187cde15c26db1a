#pragma once
#include "store/frame.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace lamella::render {

/// The membrane of a frame, ready to draw or to cut.
struct Surface {
  Frame fine; ///< phi, and psi with phases, around the membrane, refined
  /// Triangles of phi = 0; point data: Normals (unit, outward, from the gradient of phi) and
  /// "occlusion", from 0 (open) to 1 (hidden in a dimple, a neck or between two membranes). With
  /// phases the scalars are psi.
  vtkSmartPointer<vtkPolyData> mesh;

  bool has_phases() const { return !fine.psi.empty(); }
};

/// Throws RenderError when phi has no zero.
Surface extract_surface(const Frame& frame);

} // namespace lamella::render
