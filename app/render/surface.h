#pragma once
#include "store/frame.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace lamella::render {

/// The membrane of a frame, ready to draw or to cut.
struct Surface {
  Frame fine; ///< phi, and psi with phases, around the membrane, refined
  /// From vtkMembraneSurface, with more point data: "occlusion", from 0 (open) to 1 (hidden in a
  /// dimple, a neck or between two membranes). With phases the scalars are psi.
  vtkSmartPointer<vtkPolyData> mesh;

  bool has_phases() const { return !fine.psi.empty(); }
};

/// Throws RenderError when phi is nowhere negative.
Surface extract_surface(const Frame& frame);

} // namespace lamella::render
