#include "fields/contour.h"

#include "fields/sampler.h"
#include "parallel.h"

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

namespace lamella {
namespace {

constexpr std::size_t chunk = 1024; // points

vtkSmartPointer<vtkPolyData> flying_edges(const Frame& frame) {
  std::vector<double>& shared = const_cast<std::vector<double>&>(frame.phi); // read only
  vtkNew<vtkDoubleArray> values;
  values->SetArray(shared.data(), vtkIdType(shared.size()), 1);
  vtkNew<vtkImageData> image;
  image->SetDimensions(frame.grid.nodes.data());
  image->SetSpacing(frame.grid.spacing, frame.grid.spacing, frame.grid.spacing);
  image->SetOrigin(frame.grid.origin(0), frame.grid.origin(1), frame.grid.origin(2));
  image->GetPointData()->SetScalars(values);
  vtkNew<vtkFlyingEdges3D> edges;
  edges->SetInputData(image);
  edges->SetValue(0, 0.0);
  edges->ComputeNormalsOff();
  edges->ComputeGradientsOff();
  edges->ComputeScalarsOff();
  edges->Update();
  return edges->GetOutput();
}

/// The filter winds triangles around the direction of falling values: inward. VTK lights by
/// winding.
void turn(vtkCellArray& triangles) {
  triangles.ConvertTo64BitStorage();
  auto* corner = triangles.GetConnectivityArray64()->GetPointer(0);
  for (vtkIdType n = 0; n < triangles.GetNumberOfCells(); ++n, corner += 3)
    std::swap(corner[1], corner[2]);
}

/// f(point, its place) for all points of a mesh.
template <class F>
void for_each_point(vtkPolyData& mesh, F&& f) {
  vtkPoints* points = mesh.GetPoints();
  parallel_for(std::size_t(mesh.GetNumberOfPoints()), chunk,
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t n = begin; n < end; ++n) {
                   Vec3 p;
                   points->GetPoint(vtkIdType(n), p.data());
                   f(n, p);
                 }
               });
}

void add_field(vtkPolyData& mesh, const char* name, const Grid& grid,
               const std::vector<double>& nodal) {
  const Sampler field(grid, nodal);
  vtkNew<vtkDoubleArray> values;
  values->SetName(name);
  values->SetNumberOfTuples(mesh.GetNumberOfPoints());
  double* const out = values->GetPointer(0);
  for_each_point(mesh, [&](std::size_t n, const Vec3& p) { out[n] = field.value(p); });
  mesh.GetPointData()->AddArray(values);
}

} // namespace

vtkSmartPointer<vtkPolyData> contour(const Frame& frame) {
  vtkSmartPointer<vtkPolyData> mesh = flying_edges(frame);
  turn(*mesh->GetPolys());
  return mesh;
}

void add_normals(vtkPolyData& mesh, const Frame& frame) {
  const Sampler phi(frame.grid, frame.phi);
  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(mesh.GetNumberOfPoints());
  float* const out = normals->GetPointer(0);
  for_each_point(mesh, [&](std::size_t n, const Vec3& p) {
    const Vec3 gradient = phi.gradient(p);
    const double length = std::hypot(gradient[0], gradient[1], gradient[2]);
    for (int a = 0; a < 3; ++a) out[3 * n + a] = float(gradient[a] / std::max(length, 1e-300));
  });
  mesh.GetPointData()->SetNormals(normals);
}

void add_fields(vtkPolyData& mesh, const Frame& frame) {
  for (const auto& [name, values] : frame.fields) add_field(mesh, name.c_str(), frame.grid, values);
  if (frame.has("psi")) mesh.GetPointData()->SetActiveScalars("psi");
}

} // namespace lamella
