#include "render/cross_section.h"

#include "fields/sampler.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFlyingEdges2D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStripper.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace lamella::render {
namespace {

/// The number of nodes inside (phi < 0) in every layer of constant y.
std::vector<double> inside_by_layer(const Frame& frame) {
  const Grid& grid = frame.grid;
  std::vector<double> inside(grid.ny(), 0);
  for (int k = 0; k < grid.nz(); ++k)
    for (int j = 0; j < grid.ny(); ++j) {
      const auto row = frame.phi.begin() + grid.index(0, j, k);
      inside[j] += std::count_if(row, row + grid.nx(), [](double phi) { return phi < 0; });
    }
  return inside;
}

/// Where to cut, in layers; not a whole number in general.
double cutting_layer(const Frame& frame) {
  const std::vector<double> inside = inside_by_layer(frame);
  double sum = 0, moment = 0;
  for (std::size_t j = 0; j < inside.size(); ++j) sum += inside[j], moment += inside[j] * j;
  const double centroid = moment / sum;
  if (inside[std::size_t(std::lround(centroid))] > 0) return centroid;
  return double(std::max_element(inside.begin(), inside.end()) - inside.begin());
}

vtkSmartPointer<vtkImageData> slice(const Frame& frame, double layer) {
  const Grid& grid = frame.grid;
  const int j = std::clamp(int(std::floor(layer)), 0, grid.ny() - 2);
  const double t = layer - j;
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(grid.nx(), grid.nz(), 1);
  image->SetSpacing(grid.spacing, grid.spacing, 1);
  image->SetOrigin(grid.origin(0), grid.origin(2), 0);
  image->AllocateScalars(VTK_DOUBLE, 1);
  auto* out = static_cast<double*>(image->GetScalarPointer());
  for (int k = 0; k < grid.nz(); ++k)
    for (int i = 0; i < grid.nx(); ++i)
      *out++ = (1 - t) * frame.phi[grid.index(i, j, k)] + t * frame.phi[grid.index(i, j + 1, k)];
  return image;
}

/// The lines phi = 0 in a layer, each closed.
std::vector<std::vector<Vec2>> closed_lines(const Frame& frame, double layer) {
  vtkNew<vtkFlyingEdges2D> edges;
  edges->SetInputData(slice(frame, layer));
  edges->SetValue(0, 0.0);
  edges->ComputeScalarsOff();
  vtkNew<vtkStripper> chain;
  chain->SetInputConnection(edges->GetOutputPort());
  chain->JoinContiguousSegmentsOn();
  chain->SetMaximumLength(1 << 24);
  chain->Update();

  std::vector<std::vector<Vec2>> lines;
  vtkPolyData* output = chain->GetOutput();
  vtkCellArray* cells = output->GetLines();
  cells->InitTraversal();
  const vtkIdType* ids = nullptr;
  for (vtkIdType count = 0; cells->GetNextCell(count, ids);) {
    if (count > 1 && ids[0] == ids[count - 1]) --count; // closed: the first point is there twice
    std::vector<Vec2> line;
    for (vtkIdType n = 0; n < count; ++n) {
      Vec3 p;
      output->GetPoint(ids[n], p.data());
      line.push_back({p[0], p[1]});
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

/// A closed line cut where psi changes its sign from one point to the next.
std::vector<Outline> cut(const std::vector<Vec2>& line, const std::vector<double>& psi) {
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

std::vector<Outline> cross_section(const Surface& surface) {
  const Frame& fine = surface.fine;
  const double layer = cutting_layer(fine), y = fine.grid.origin(1) + layer * fine.grid.spacing;
  const Sampler psi(fine.grid, fine.psi);
  std::vector<Outline> outlines;
  for (const std::vector<Vec2>& line : closed_lines(fine, layer)) {
    if (!surface.has_phases()) {
      outlines.push_back({Part::whole, line, true});
      continue;
    }
    std::vector<double> values;
    for (const auto& [x, z] : line) values.push_back(psi.value({x, y, z}));
    std::ranges::move(cut(line, values), std::back_inserter(outlines));
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
