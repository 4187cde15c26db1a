#include "vtkPhaseBoundary.h"

#include "dynamics/event.h"
#include "fields/image.h"
#include "fields/report.h"
#include "fields/spline_geometry.h"
#include "geometry/phase_boundary.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>

vtkStandardNewMacro(vtkPhaseBoundary);

namespace
{
// Spacings. The corners of cells that the membrane passes through are at most sqrt(3) away; the trace
// does not look at what is farther.
constexpr double BandHalfWidth = 2;

lamella::PhaseBoundary Trace(const lamella::Frame& frame)
{
  const lamella::LevelSet phi = lamella::fitted(frame.grid, frame.phi);
  const lamella::LevelSet psi = lamella::fitted(frame.grid, frame.field("psi"));
  lamella::NarrowBand band(frame.grid, BandHalfWidth);
  band.update(phi);
  lamella::PhaseBoundary boundary;
  boundary.trace(phi, psi, band);
  return boundary;
}

void AddLines(vtkPolyData& lines, const lamella::PhaseBoundary& boundary)
{
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkDoubleArray> length;
  length->SetName("length");
  vtkIdType first = 0;
  for (std::size_t c = 0; c < boundary.curves(); ++c)
  {
    const auto curve = boundary.curve(c);
    const auto count = static_cast<vtkIdType>(curve.size());
    cells->InsertNextCell(static_cast<int>(count) + 1);
    double sum = 0;
    for (vtkIdType n = 0; n < count; ++n)
    {
      cells->InsertCellPoint(first + n);
      sum += curve[n].weight;
    }
    cells->InsertCellPoint(first);
    length->InsertNextValue(sum);
    first += count;
  }
  lines.SetLines(cells);
  lines.GetCellData()->AddArray(length);
}

/** value(point, component) at all points. */
template <class Array, class Value>
void AddArray(vtkPolyData& lines, const char* name, int components,
  const lamella::PhaseBoundary& boundary, Value&& value)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  for (const lamella::BoundaryPoint& p : boundary.points())
  {
    for (int component = 0; component < components; ++component)
    {
      array->InsertNextValue(static_cast<typename Array::ValueType>(value(p, component)));
    }
  }
  lines.GetPointData()->AddArray(array);
}

void AddGeometry(vtkPolyData& lines, const lamella::PhaseBoundary& boundary)
{
  using Point = lamella::BoundaryPoint;
  AddArray<vtkFloatArray>(
    lines, "Normals", 3, boundary, [](const Point& p, int axis) { return p.N[axis]; });
  lines.GetPointData()->SetActiveNormals("Normals");
  AddArray<vtkDoubleArray>(
    lines, "tangent", 3, boundary, [](const Point& p, int axis) { return p.t[axis]; });
  AddArray<vtkDoubleArray>(lines, "kg", 1, boundary, [](const Point& p, int) { return p.kg; });
  AddArray<vtkDoubleArray>(lines, "kn", 1, boundary, [](const Point& p, int) { return p.kn; });
  AddArray<vtkDoubleArray>(
    lines, "tau_g", 1, boundary, [](const Point& p, int) { return p.tau_g; });
  AddArray<vtkDoubleArray>(
    lines, "B_perp", 1, boundary, [](const Point& p, int) { return p.B_perp; });
  AddArray<vtkDoubleArray>(
    lines, "arc_length", 1, boundary, [](const Point& p, int) { return p.s; });
}

std::string PlacesText(const lamella::PhaseBoundary& boundary, const lamella::ImageVesicle& vesicle)
{
  std::string text;
  for (const Eigen::Vector3d& x : boundary.unresolved())
  {
    text += (text.empty() ? "" : ", ") +
      lamella::place_text(vesicle.in_image({ x[0], x[1], x[2] }), vesicle.frame.grid.spacing);
  }
  return text;
}
}

int vtkPhaseBoundary::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkPhaseBoundary::RequestData(
  vtkInformation*, vtkInformationVector** input, vtkInformationVector* output)
{
  return lamella::reporting(this,
    [&]
    {
      const auto vesicle =
        lamella::vesicle_in(*vtkImageData::GetData(input[0]), { this->PhiArray });
      lamella::remark(this, vesicle.remark);
      if (!vesicle.frame.has("psi"))
      {
        throw lamella::InputError("the image has no point data array \"psi\": the membrane has "
                                  "one phase, which has no boundary");
      }
      const lamella::PhaseBoundary boundary = Trace(vesicle.frame);
      if (!boundary.unresolved().empty())
      {
        vtkWarningMacro("left out what cannot be followed, the grid being too coarse for it, at "
          << PlacesText(boundary, vesicle));
      }
      vtkNew<vtkPoints> points;
      points->SetDataTypeToDouble();
      for (const lamella::BoundaryPoint& p : boundary.points())
      {
        points->InsertNextPoint(vesicle.in_image({ p.x[0], p.x[1], p.x[2] }).data());
      }
      vtkPolyData* lines = vtkPolyData::GetData(output);
      lines->SetPoints(points);
      AddLines(*lines, boundary);
      AddGeometry(*lines, boundary);
    });
}

void vtkPhaseBoundary::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "PhiArray: " << this->PhiArray << "\n";
}
