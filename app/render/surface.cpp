#include "render/surface.h"

#include "render/labels.h"
#include "render/occlusion.h"
#include "render/refine.h"
#include "render/render.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkTypeInt64Array.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lamella::render {
namespace {

/// Cells of the refined lattice along the half-diagonal of the shape's bounding box: facets then
/// cannot be seen.
constexpr int fine_cells = 90;
constexpr int largest_refinement = 4;

vtkSmartPointer<vtkPolyData> contour(Frame& fine) {
  vtkNew<vtkDoubleArray> values; // shares the frame's memory
  values->SetArray(fine.phi.data(), vtkIdType(fine.phi.size()), 1);
  vtkNew<vtkImageData> image;
  image->SetDimensions(fine.grid.nodes.data());
  image->SetSpacing(fine.grid.spacing, fine.grid.spacing, fine.grid.spacing);
  image->SetOrigin(fine.grid.origin(0), fine.grid.origin(1), fine.grid.origin(2));
  image->GetPointData()->SetScalars(values);
  vtkNew<vtkFlyingEdges3D> edges;
  edges->SetInputData(image);
  edges->SetValue(0, 0.0);
  edges->ComputeNormalsOff();
  edges->ComputeGradientsOff();
  edges->ComputeScalarsOff();
  edges->Update();

  // The filter winds triangles around the direction of falling values: inward. VTK lights by
  // winding.
  vtkCellArray* triangles = edges->GetOutput()->GetPolys();
  triangles->ConvertTo64BitStorage();
  auto* corner = triangles->GetConnectivityArray64()->GetPointer(0);
  for (vtkIdType n = 0; n < triangles->GetNumberOfCells(); ++n, corner += 3)
    std::swap(corner[1], corner[2]);
  return edges->GetOutput();
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

void add_point_data(vtkPolyData& mesh, const Frame& fine, const Occlusion& occlusion) {
  const Sampler phi(fine.grid, fine.phi);
  const vtkIdType points = mesh.GetNumberOfPoints();
  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(points);
  vtkNew<vtkFloatArray> shade;
  shade->SetName("occlusion");
  shade->SetNumberOfTuples(points);
  for (vtkIdType n = 0; n < points; ++n) {
    Vec3 p;
    mesh.GetPoint(n, p.data());
    Vec3 normal = phi.gradient(p);
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    for (double& x : normal) x /= std::max(length, 1e-300);
    for (int a = 0; a < 3; ++a) normals->SetTypedComponent(n, a, float(normal[a]));
    shade->SetValue(n, float(occlusion.at(p, normal)));
  }
  mesh.GetPointData()->SetNormals(normals);
  mesh.GetPointData()->AddArray(shade);
}

void add_psi(vtkPolyData& mesh, const Frame& fine) {
  const Sampler psi(fine.grid, fine.psi);
  vtkNew<vtkDoubleArray> values;
  values->SetName("psi");
  values->SetNumberOfTuples(mesh.GetNumberOfPoints());
  for (vtkIdType n = 0; n < mesh.GetNumberOfPoints(); ++n) {
    Vec3 p;
    mesh.GetPoint(n, p.data());
    values->SetValue(n, psi.value(p));
  }
  mesh.GetPointData()->SetScalars(values);
}

} // namespace

Surface extract_surface(const Frame& frame) {
  const double size = half_size(frame), shadow = 0.12 * size;
  const double wanted = size > 0 ? fine_cells * frame.grid.spacing / size : 1;
  const int factor = std::clamp(int(std::ceil(wanted)), 1, largest_refinement);
  const Frame around = crop(frame, 2 * shadow + 4 * frame.grid.spacing);
  Surface surface{refine(around, factor), nullptr};
  surface.mesh = contour(surface.fine);
  if (surface.mesh->GetNumberOfPoints() == 0)
    throw RenderError("nothing to draw: the level set at t = " + plain(number(frame.time)) +
                      " has no membrane");
  add_point_data(*surface.mesh, surface.fine, Occlusion(around, shadow));
  if (surface.has_phases()) add_psi(*surface.mesh, surface.fine);
  return surface;
}

} // namespace lamella::render
