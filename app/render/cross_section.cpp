#include "render/cross_section.h"

#include <vtkCellArray.h>
#include <vtkContourFilter.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStripper.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace lamella::render {
namespace {

/// A line of a cut, with psi at its points where there are phases.
struct Cut {
  std::vector<Vec2> points;
  std::vector<double> psi;
};

/// Depths of the mesh's points toward the eye.
vtkSmartPointer<vtkDoubleArray> depths(vtkPolyData& mesh, const Viewpoint& level) {
  const Vec3 toward_eye = level.lift({0, 0, 1});
  auto depth = vtkSmartPointer<vtkDoubleArray>::New();
  depth->SetName("depth");
  depth->SetNumberOfTuples(mesh.GetNumberOfPoints());
  for (vtkIdType n = 0; n < mesh.GetNumberOfPoints(); ++n) {
    Vec3 p;
    mesh.GetPoint(n, p.data());
    depth->SetValue(n, p[0] * toward_eye[0] + p[1] * toward_eye[1] + p[2] * toward_eye[2]);
  }
  return depth;
}

/// The chains of points at a depth, each closed.
std::vector<Cut> cuts(const Surface& surface, const Viewpoint& level, vtkDoubleArray& depth,
                      double at) {
  vtkNew<vtkPolyData> mesh;
  mesh->CopyStructure(surface.mesh);
  mesh->GetPointData()->AddArray(surface.mesh->GetPointData()->GetArray("psi"));
  mesh->GetPointData()->SetScalars(&depth);
  vtkNew<vtkContourFilter> contour;
  contour->SetInputData(mesh);
  contour->SetValue(0, at);
  vtkNew<vtkStripper> chain;
  chain->SetInputConnection(contour->GetOutputPort());
  chain->JoinContiguousSegmentsOn();
  chain->SetMaximumLength(1 << 24);
  chain->Update();

  std::vector<Cut> all;
  vtkPolyData* output = chain->GetOutput();
  vtkDataArray* psi = output->GetPointData()->GetArray("psi");
  vtkCellArray* cells = output->GetLines();
  cells->InitTraversal();
  const vtkIdType* ids = nullptr;
  for (vtkIdType count = 0; cells->GetNextCell(count, ids);) {
    if (count > 1 && ids[0] == ids[count - 1]) --count; // closed: the first point is there twice
    Cut cut;
    for (vtkIdType n = 0; n < count; ++n) {
      Vec3 p;
      output->GetPoint(ids[n], p.data());
      cut.points.push_back(level.project(p));
      if (psi) cut.psi.push_back(psi->GetTuple1(ids[n]));
    }
    all.push_back(std::move(cut));
  }
  return all;
}

/// Slightly off what may be a layer of the lattice, where a cut would meet whole edges.
double off_lattice(double depth, double extent) { return depth + 1.7e-6 * extent; }

double cutting_depth(vtkDoubleArray& depth) {
  std::vector<double> all(depth.Begin(), depth.End());
  std::ranges::sort(all);
  const double extent = all.back() - all.front();
  double mean = 0;
  for (const double depth : all) mean += depth / double(all.size());
  const auto above = std::ranges::lower_bound(all, mean);
  const double gap = above == all.end() || above == all.begin() ? 0 : *above - *(above - 1);
  if (gap < 0.05 * extent) return off_lattice(mean, extent);
  const double nearest = all[all.size() / 4]; // the middle of what is on the far side
  return off_lattice(nearest, extent);
}

/// A closed line cut where psi changes its sign from one point to the next.
std::vector<Outline> parted(const Cut& cut) {
  const auto& [line, psi] = cut;
  const auto part = [&](std::size_t n) { return psi[n] < 0 ? Part::Ld : Part::Lo; };
  const auto next = [&](std::size_t n) { return (n + 1) % line.size(); };
  const auto boundary = [&](std::size_t n) { // between a point and the next
    const double t = psi[n] / (psi[n] - psi[next(n)]);
    return Vec2{std::lerp(line[n][0], line[next(n)][0], t),
                std::lerp(line[n][1], line[next(n)][1], t)};
  };
  std::size_t first = 0; // the last point before a boundary
  while (first < line.size() && part(first) == part(next(first))) ++first;
  if (first == line.size()) return {{part(0), line, true}};

  std::vector<Outline> pieces;
  std::size_t n = first;
  do {
    Outline piece{part(next(n)), {boundary(n)}, false};
    do piece.points.push_back(line[n = next(n)]);
    while (part(n) == part(next(n)));
    piece.points.push_back(boundary(n));
    pieces.push_back(std::move(piece));
  } while (n != first);
  return pieces;
}

} // namespace

std::vector<Outline> cross_section(const Surface& surface, double azimuth) {
  const Viewpoint level(0, azimuth);
  const auto depth = depths(*surface.mesh, level);
  std::vector<Outline> outlines;
  for (const Cut& cut : cuts(surface, level, *depth, cutting_depth(*depth))) {
    if (surface.has_phases())
      std::ranges::move(parted(cut), std::back_inserter(outlines));
    else
      outlines.push_back({Part::whole, cut.points, true});
  }
  return outlines;
}

Extent extent_of(const std::vector<Outline>& lines) {
  Extent extent;
  for (const Outline& line : lines)
    for (const Vec2& p : line.points) extent.include(p);
  return extent;
}

} // namespace lamella::render
