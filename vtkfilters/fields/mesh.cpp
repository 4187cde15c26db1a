#include "fields/mesh.h"

#include "fields/image.h"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkNew.h>
#include <vtkTriangleFilter.h>

#include <map>
#include <tuple>

namespace lamella {
namespace {

using Eigen::Vector3d;

vtkSmartPointer<vtkPolyData> triangulated(vtkPolyData& surface) {
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(&surface);
  triangles->PassVertsOff();
  triangles->PassLinesOff();
  triangles->Update();
  return triangles->GetOutput();
}

/// The points of a mesh, each new one added once.
class DistinctPoints {
public:
  explicit DistinctPoints(Mesh& mesh) : mesh_(mesh) {}

  int index_of(const Vector3d& p) {
    const auto [at, is_new] = indices_.try_emplace({p[0], p[1], p[2]}, int(mesh_.points.size()));
    if (is_new) mesh_.points.push_back(p);
    return at->second;
  }

private:
  Mesh& mesh_;
  std::map<std::tuple<double, double, double>, int> indices_;
};

} // namespace

Mesh mesh_of(vtkPolyData& surface) {
  const auto triangles = triangulated(surface);
  Mesh mesh;
  DistinctPoints points(mesh);
  const auto cells = vtk::TakeSmartPointer(triangles->GetPolys()->NewIterator());
  for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell()) {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    cells->GetCurrentCell(count, ids);
    std::array<int, 3> corners{};
    for (int i = 0; i < 3; ++i) {
      const Vector3d p(triangles->GetPoint(ids[i]));
      if (!p.allFinite()) throw InputError("the surface has points that are not finite");
      corners[i] = points.index_of(p);
    }
    const auto& [a, b, c] = corners;
    if (a != b && b != c && c != a) mesh.triangles.push_back(corners);
  }
  if (mesh.triangles.empty())
    throw InputError("the surface has no triangles; a closed one is needed");
  return mesh;
}

MeshBounds bounds_of(const Mesh& mesh) {
  MeshBounds bounds{mesh.points.front(), mesh.points.front()};
  for (const Vector3d& p : mesh.points) {
    bounds.low = bounds.low.cwiseMin(p);
    bounds.high = bounds.high.cwiseMax(p);
  }
  return bounds;
}

void scale(Mesh& mesh, double longest_side) {
  const auto [low, high] = bounds_of(mesh);
  const Vector3d middle = 0.5 * (low + high);
  const double factor = longest_side / (high - low).maxCoeff();
  for (Vector3d& p : mesh.points) p = factor * (p - middle);
}

} // namespace lamella
