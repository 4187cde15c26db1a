#include "render/surface.h"

#include "fields/image.h"
#include "fields/refine.h"
#include "render/labels.h"
#include "render/occlusion.h"
#include "render/render.h"

#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMembraneSurface.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>

namespace lamella::render {
namespace {

/// Cells of the refined lattice along the half-diagonal of the shape's bounding box: facets then
/// cannot be seen.
constexpr int fine_cells = 90;
constexpr int largest_refinement = 4;

vtkSmartPointer<vtkPolyData> membrane(const Frame& fine) {
  vtkNew<vtkImageData> image;
  fill_image(*image, fine);
  vtkNew<vtkMembraneSurface> surface;
  surface->SetInputData(image);
  surface->SetRefinement(1); // it is refined
  surface->ComputeCurvaturesOff();
  surface->Update();
  return surface->GetOutput();
}

/// The half-diagonal of the inside's bounding box.
double half_size(const Frame& frame) {
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (std::size_t n = 0; n < frame.phi.size(); ++n) {
    if (!(frame.phi[n] < 0)) continue;
    const Vec3 p = frame.grid.position(n);
    for (int a = 0; a < 3; ++a) low[a] = std::min(low[a], p[a]), high[a] = std::max(high[a], p[a]);
  }
  if (low[0] > high[0]) return 0;
  return 0.5 * std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

void add_occlusion(vtkPolyData& mesh, const Occlusion& occlusion) {
  vtkDataArray* normals = mesh.GetPointData()->GetNormals();
  vtkNew<vtkFloatArray> shade;
  shade->SetName("occlusion");
  shade->SetNumberOfTuples(mesh.GetNumberOfPoints());
  for (vtkIdType n = 0; n < mesh.GetNumberOfPoints(); ++n) {
    Vec3 p, normal;
    mesh.GetPoint(n, p.data());
    normals->GetTuple(n, normal.data());
    shade->SetValue(n, float(occlusion.at(p, normal)));
  }
  mesh.GetPointData()->AddArray(shade);
}

} // namespace

Surface extract_surface(const Frame& frame) {
  const double size = half_size(frame), shadow = 0.12 * size;
  if (size == 0)
    throw RenderError("nothing to draw: the level set at t = " + plain(number(frame.time)) +
                      " has no membrane");
  const double wanted = fine_cells * frame.grid.spacing / size;
  const int factor = std::clamp(int(std::ceil(wanted)), 1, largest_refinement);
  const Frame around = crop(frame, 2 * shadow + 4 * frame.grid.spacing);
  Surface surface{refine(around, factor), nullptr};
  surface.mesh = membrane(surface.fine);
  add_occlusion(*surface.mesh, Occlusion(around, shadow));
  return surface;
}

} // namespace lamella::render
