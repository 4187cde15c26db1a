#include "render/phases.h"

#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <map>
#include <utility>

namespace lamella::render {
namespace {

using Edge = std::pair<vtkIdType, vtkIdType>; ///< its points in ascending order

/// Where psi, linear along an edge, is 0: how far from its first point.
double zero(const std::vector<double>& psi, const Edge& edge) {
  return psi[edge.first] / (psi[edge.first] - psi[edge.second]);
}

/// What of a triangle mesh is on one side of psi = 0. vtkClipPolyData does the same in ten times
/// the time: it looks every point up by its place.
class Side {
public:
  Side(vtkPolyData& mesh, const std::vector<double>& psi, bool positive)
      : mesh_(mesh), psi_(psi), positive_(positive), index_(psi.size(), -1) {
    vtkIdType count = 0;
    const vtkIdType* corners = nullptr;
    for (vtkIdType n = 0; n < mesh.GetNumberOfPolys(); ++n) {
      mesh.GetPolys()->GetCellAtId(n, count, corners);
      add(corners);
    }
  }

  /// Points on the cut come last.
  vtkSmartPointer<vtkPolyData> patch() const {
    auto patch = vtkSmartPointer<vtkPolyData>::New();
    patch->SetPoints(points());
    patch->SetPolys(polys());
    vtkPointData *from = mesh_.GetPointData(), *data = patch->GetPointData();
    data->InterpolateAllocate(from, patch->GetNumberOfPoints());
    data->CopyData(from, whole_, numbers_);
    for (const auto& [edge, n] : cuts_)
      data->InterpolateEdge(from, whole_->GetNumberOfIds() + n, edge.first, edge.second,
                            zero(psi_, edge));
    return patch;
  }

private:
  bool has(vtkIdType point) const { return (psi_[point] >= 0) == positive_; }

  vtkIdType index_of(vtkIdType point) {
    if (index_[point] < 0) {
      index_[point] = whole_->InsertNextId(point);
      numbers_->InsertNextId(index_[point]);
    }
    return index_[point];
  }

  /// Less than 0: how many points that are not on the cut will come before it, is not known yet.
  vtkIdType index_of(const Edge& edge) {
    return -1 - cuts_.try_emplace(edge, vtkIdType(cuts_.size())).first->second;
  }

  /// What is on this side of a triangle: it, a triangle or a quadrangle, or nothing.
  void add(const vtkIdType* corners) {
    vtkIdType polygon[4];
    int count = 0;
    for (int i = 0; i < 3; ++i) {
      const vtkIdType a = corners[i], b = corners[(i + 1) % 3];
      if (has(a)) polygon[count++] = index_of(a);
      if (has(a) != has(b)) polygon[count++] = index_of(Edge(std::minmax(a, b)));
    }
    for (int i = 2; i < count; ++i)
      triangles_.insert(triangles_.end(), {polygon[0], polygon[i - 1], polygon[i]});
  }

  vtkSmartPointer<vtkPoints> points() const {
    vtkPoints& from = *mesh_.GetPoints();
    auto points = vtkSmartPointer<vtkPoints>::New();
    points->SetDataType(from.GetDataType());
    points->GetData()->InsertTuples(numbers_, whole_, from.GetData());
    for (const auto& [edge, n] : cuts_)
      points->GetData()->InterpolateTuple(whole_->GetNumberOfIds() + n, edge.first, from.GetData(),
                                          edge.second, from.GetData(), zero(psi_, edge));
    return points;
  }

  vtkSmartPointer<vtkCellArray> polys() const {
    const vtkIdType whole = whole_->GetNumberOfIds();
    vtkNew<vtkIdTypeArray> corners;
    corners->SetNumberOfValues(vtkIdType(triangles_.size()));
    std::ranges::transform(triangles_, corners->GetPointer(0),
                           [=](vtkIdType n) { return n < 0 ? whole - 1 - n : n; });
    auto polys = vtkSmartPointer<vtkCellArray>::New();
    polys->SetData(3, corners);
    return polys;
  }

  vtkPolyData& mesh_;
  const std::vector<double>& psi_;
  bool positive_;
  vtkNew<vtkIdList> whole_, numbers_; ///< points of the mesh on this side; 0, 1, 2, ...
  std::vector<vtkIdType> index_;      ///< of those in the patch, -1 of others
  std::map<Edge, vtkIdType> cuts_;    ///< edges from one side to the other, in the order found
  std::vector<vtkIdType> triangles_;  ///< their corners
};

} // namespace

std::vector<Patch> patches(vtkPolyData& mesh) {
  vtkDataArray* scalars = mesh.GetPointData()->GetScalars();
  if (!scalars) return {{Part::whole, &mesh}};
  std::vector<double> psi;
  for (vtkIdType n = 0; n < mesh.GetNumberOfPoints(); ++n) psi.push_back(scalars->GetTuple1(n));
  std::vector<Patch> both{{Part::Ld, Side(mesh, psi, false).patch()},
                          {Part::Lo, Side(mesh, psi, true).patch()}};
  std::erase_if(both, [](const Patch& patch) { return patch.mesh->GetNumberOfPolys() == 0; });
  return both;
}

} // namespace lamella::render
