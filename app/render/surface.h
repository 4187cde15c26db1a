#pragma once
#include "store/frame.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace lamella::render {

/// The membrane of a frame, ready to draw or to cut.
struct Surface {
  Frame fine; ///< the level set around the membrane, refined
  /// Triangles of phi = 0; point data: Normals (unit, outward, from the gradient of phi) and
  /// "occlusion", from 0 (open) to 1 (hidden in a dimple, a neck or between two membranes).
  vtkSmartPointer<vtkPolyData> mesh;
};

/// Throws RenderError when phi has no zero.
Surface extract_surface(const Frame& frame);

} // namespace lamella::render
