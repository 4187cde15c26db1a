#pragma once
#include "render/style.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <vector>

namespace lamella::render {

/// What of a membrane: all of one with a single phase, or what is in one of two phases.
enum class Part { whole, Ld, Lo };

inline const style::Hue& hue(Part part) {
  return part == Part::Ld ? style::Ld : part == Part::Lo ? style::Lo : style::membrane;
}

/// A part of a membrane as triangles.
struct Patch {
  Part part;
  vtkSmartPointer<vtkPolyData> mesh;
};

/// The patches that make up a mesh, cut exactly along psi = 0 where its active scalars are psi.
std::vector<Patch> patches(vtkPolyData& mesh);

} // namespace lamella::render
