#include "render/surface.h"

#include "render/labels.h"
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

/// phi and its gradient between the nodes, trilinear.
class Sampler {
public:
  explicit Sampler(const Frame& frame) : frame_(frame) {}

  double value(const Vec3& p) const {
    return interpolate(p, [&](int i, int j, int k) { return node(i, j, k); });
  }

  Vec3 gradient(const Vec3& p) const {
    Vec3 g;
    for (int a = 0; a < 3; ++a)
      g[a] = interpolate(p, [&](int i, int j, int k) { return difference(a, i, j, k); });
    return g;
  }

private:
  double node(int i, int j, int k) const {
    const auto& n = frame_.grid.nodes;
    return frame_.phi[frame_.grid.index(std::clamp(i, 0, n[0] - 1), std::clamp(j, 0, n[1] - 1),
                                        std::clamp(k, 0, n[2] - 1))];
  }

  /// Fourth-order central difference along an axis, times the spacing.
  double difference(int axis, int i, int j, int k) const {
    const std::array<int, 3> d{axis == 0, axis == 1, axis == 2};
    const auto at = [&](int s) { return node(i + s * d[0], j + s * d[1], k + s * d[2]); };
    return (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / 12;
  }

  template <class Node>
  double interpolate(const Vec3& p, Node&& node) const {
    const Grid& grid = frame_.grid;
    std::array<int, 3> base;
    Vec3 t;
    for (int a = 0; a < 3; ++a) {
      const double x = (p[a] - grid.origin(a)) / grid.spacing;
      base[a] = std::clamp(int(std::floor(x)), 0, std::max(0, grid.nodes[a] - 2));
      t[a] = std::clamp(x - base[a], 0.0, 1.0);
    }
    double sum = 0;
    for (int c = 0; c < 8; ++c) {
      const int i = c & 1, j = c >> 1 & 1, k = c >> 2;
      const double weight = (i ? t[0] : 1 - t[0]) * (j ? t[1] : 1 - t[1]) * (k ? t[2] : 1 - t[2]);
      if (weight > 0) sum += weight * node(base[0] + i, base[1] + j, base[2] + k);
    }
    return sum;
  }

  const Frame& frame_;
};

/// How much of the outside, up to a distance `reach` along the normal, comes closer to some other
/// part of the membrane than to p: what a signed distance function tells of ambient light.
double occlusion(const Sampler& phi, const Vec3& p, const Vec3& normal, double reach) {
  constexpr int samples = 5;
  double sum = 0, weights = 0;
  for (int s = 1; s <= samples; ++s) {
    const double distance = reach * s / samples, weight = 1.0 / s;
    Vec3 q;
    for (int a = 0; a < 3; ++a) q[a] = p[a] + distance * normal[a];
    sum += weight * std::clamp(1 - phi.value(q) / distance, 0.0, 1.0);
    weights += weight;
  }
  return sum / weights;
}

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

void add_point_data(vtkPolyData& mesh, const Frame& fine, double reach) {
  const Sampler phi(fine);
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
    shade->SetValue(n, float(occlusion(phi, p, normal, reach)));
  }
  mesh.GetPointData()->SetNormals(normals);
  mesh.GetPointData()->AddArray(shade);
}

} // namespace

Surface extract_surface(const Frame& frame) {
  const double size = half_size(frame), reach = 0.25 * size;
  const double wanted = size > 0 ? fine_cells * frame.grid.spacing / size : 1;
  const int factor = std::clamp(int(std::ceil(wanted)), 1, largest_refinement);
  Surface surface{refine(crop(frame, reach + 4 * frame.grid.spacing), factor), nullptr};
  surface.mesh = contour(surface.fine);
  if (surface.mesh->GetNumberOfPoints() == 0)
    throw RenderError("nothing to draw: the level set at t = " + plain(number(frame.time)) +
                      " has no membrane");
  add_point_data(*surface.mesh, surface.fine, reach);
  return surface;
}

} // namespace lamella::render
