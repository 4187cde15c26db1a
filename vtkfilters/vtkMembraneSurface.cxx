#include "vtkMembraneSurface.h"

#include "energy/surface_energy.h"

#include "fields/contour.h"
#include "fields/field_data.h"
#include "fields/image.h"
#include "fields/refine.h"
#include "fields/report.h"
#include "fields/spline_geometry.h"
#include "fields/velocity.h"

#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <numeric>

vtkStandardNewMacro(vtkMembraneSurface);

namespace
{
using lamella::Frame;
using lamella::LevelSet;
using lamella::SplineGeometry;

constexpr int Margin = 4; // spacings around the membrane that refining needs

// Facets have less area than the membrane: of it, ChordDeficit times the squared spacing and the mean
// of K_M^2, measured on spheres; on thin shapes less.
constexpr double ChordDeficit = 0.06, DeficitAllowed = 7e-4;
constexpr int LeastRefinement = 2, MostRefinement = 4; // beyond it the shape is not resolved

Frame Refined(const Frame& frame, int factor)
{
  return factor == 1 ? frame
                     : lamella::refine(lamella::crop(frame, Margin * frame.grid.spacing), factor);
}

/** What keeps the area of facets close to that of the membrane. */
int SuitableRefinement(const Frame& frame, const LevelSet& phi)
{
  const auto coarse = lamella::contour(frame);
  const SplineGeometry geometry = lamella::move_onto(phi, *coarse->GetPoints());
  const double squares =
    std::inner_product(geometry.KM.begin(), geometry.KM.end(), geometry.KM.begin(), 0.0);
  const double h = frame.grid.spacing, mean = squares / static_cast<double>(geometry.KM.size());
  const double wanted = std::ceil(h * std::sqrt(ChordDeficit * mean / DeficitAllowed));
  return wanted < MostRefinement ? std::max(static_cast<int>(wanted), LeastRefinement)
                                 : MostRefinement; // also where curvatures are not finite
}

double* AddArray(vtkPolyData& mesh, const char* name, int components = 1)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(mesh.GetNumberOfPoints());
  mesh.GetPointData()->AddArray(array);
  return array->GetPointer(0);
}

vtkDoubleArray* PsiOf(vtkPolyData& mesh)
{
  return vtkDoubleArray::SafeDownCast(mesh.GetPointData()->GetArray("psi"));
}

void AddPhase(vtkPolyData& mesh)
{
  vtkDoubleArray* psi = PsiOf(mesh);
  if (!psi)
  {
    return;
  }
  vtkNew<vtkUnsignedCharArray> phase;
  phase->SetName("phase");
  phase->SetNumberOfTuples(mesh.GetNumberOfPoints());
  for (vtkIdType n = 0; n < mesh.GetNumberOfPoints(); ++n)
  {
    phase->SetValue(n, psi->GetValue(n) < 0 ? 0 : 1);
  }
  mesh.GetPointData()->AddArray(phase);
}

void AddEnergyDensity(vtkPolyData& mesh, const LevelSet& phi, const SplineGeometry& geometry,
  const lamella::Scene& forces)
{
  vtkDoubleArray* psi = PsiOf(mesh);
  double* density = AddArray(mesh, "energy_density");
  const auto of = [&](const lamella::SurfaceModuli& moduli)
  { return lamella::SurfaceEnergy(moduli, forces.parameters, forces.fields); };
  const lamella::SurfaceEnergy membrane = of(forces.membrane), ld = of(forces.ld),
                               lo = of(forces.lo);
  std::vector<double> slope2(geometry.KM.size(), 0);
  if (std::max({ membrane.needs(), ld.needs(), lo.needs() }) == lamella::Derivatives::sixth)
  {
    std::vector<lamella::Vec3> places(slope2.size());
    for (std::size_t n = 0; n < places.size(); ++n)
    {
      mesh.GetPoint(static_cast<vtkIdType>(n), places[n].data());
    }
    slope2 = lamella::squared_gradient_of_KM(phi, places);
  }
  std::vector<vtkDataArray*> fields;
  for (const lamella::MaterialField& field : forces.fields)
  {
    fields.push_back(mesh.GetPointData()->GetArray(field.name.c_str()));
    if (!fields.back())
    {
      throw lamella::InputError(
        "the image has no array \"" + field.name + "\", which its energy depends on");
    }
  }
  std::vector<double> values(fields.size());
  for (std::size_t n = 0; n < geometry.KM.size(); ++n)
  {
    const bool isLd = psi && psi->GetValue(static_cast<vtkIdType>(n)) < 0;
    for (std::size_t i = 0; i < fields.size(); ++i)
    {
      values[i] = fields[i]->GetComponent(static_cast<vtkIdType>(n), 0);
    }
    density[n] = (isLd ? ld
        : psi          ? lo
                       : membrane)
                   .density(geometry.KM[n], geometry.K[n], slope2[n], values);
  }
}

/** Along the normal. */
void AddVelocity(
  vtkPolyData& mesh, const SplineGeometry& geometry, const std::vector<double>& speed)
{
  double* velocity = AddArray(mesh, "velocity", 3);
  for (std::size_t n = 0; n < speed.size(); ++n)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      velocity[3 * n + axis] = speed[n] * geometry.normals[3 * n + axis];
    }
  }
}

void AddNormals(vtkPolyData& mesh, const SplineGeometry& geometry)
{
  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(mesh.GetNumberOfPoints());
  std::copy(geometry.normals.begin(), geometry.normals.end(), normals->GetPointer(0));
  mesh.GetPointData()->SetNormals(normals);
}

/** The membrane as the spline has it; refinement 0: what suits. */
vtkSmartPointer<vtkPolyData> ExactSurface(
  const Frame& frame, int refinement, vtkDataObject& about, const lamella::SurfaceModuli& otherwise)
{
  const auto multipliers = lamella::multipliers_of(about, frame.has("psi"));
  const LevelSet phi = lamella::fitted(frame.grid, frame.phi);
  const Frame fine = Refined(frame, refinement ? refinement : SuitableRefinement(frame, phi));
  const auto mesh = lamella::contour(fine);
  const SplineGeometry geometry = lamella::move_onto(phi, *mesh->GetPoints());
  const lamella::Scene forces = lamella::forces_of(about, frame, otherwise);
  AddNormals(*mesh, geometry);
  lamella::add_fields(*mesh, fine);
  std::copy(geometry.KM.begin(), geometry.KM.end(), AddArray(*mesh, "K_M"));
  std::copy(geometry.K.begin(), geometry.K.end(), AddArray(*mesh, "K"));
  AddEnergyDensity(*mesh, phi, geometry, forces);
  if (multipliers)
  {
    AddVelocity(*mesh, geometry,
      lamella::normal_velocity(frame, phi, forces, *multipliers, *mesh->GetPoints()));
  }
  return mesh;
}

vtkSmartPointer<vtkPolyData> LinearSurface(const Frame& frame, int refinement)
{
  const Frame fine = Refined(frame, refinement ? refinement : LeastRefinement);
  const auto mesh = lamella::contour(fine);
  lamella::add_normals(*mesh, fine);
  lamella::add_fields(*mesh, fine);
  return mesh;
}

void Move(vtkPoints& points, const lamella::Vec3& by)
{
  if (by == lamella::Vec3{})
  {
    return;
  }
  for (vtkIdType n = 0; n < points.GetNumberOfPoints(); ++n)
  {
    lamella::Vec3 p;
    points.GetPoint(n, p.data());
    points.SetPoint(n, p[0] + by[0], p[1] + by[1], p[2] + by[2]);
  }
}
}

int vtkMembraneSurface::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkMembraneSurface::RequestData(
  vtkInformation*, vtkInformationVector** input, vtkInformationVector* output)
{
  return lamella::reporting(this,
    [&]
    {
      vtkImageData* image = vtkImageData::GetData(input[0]);
      const auto [frame, center, remark] = lamella::vesicle_in(*image, { this->PhiArray });
      lamella::remark(this, remark);
      const auto mesh = this->ComputeCurvatures
        ? ExactSurface(
            frame, this->Refinement, *image, { this->BendingModulus, this->SpontaneousCurvature })
        : LinearSurface(frame, this->Refinement);
      AddPhase(*mesh);
      Move(*mesh->GetPoints(), center);
      vtkPolyData::GetData(output)->ShallowCopy(mesh);
    });
}

void vtkMembraneSurface::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "PhiArray: " << this->PhiArray << "\n";
  os << indent << "Refinement: " << this->Refinement << "\n";
  os << indent << "ComputeCurvatures: " << this->ComputeCurvatures << "\n";
  os << indent << "BendingModulus: " << this->BendingModulus << "\n";
  os << indent << "SpontaneousCurvature: " << this->SpontaneousCurvature << "\n";
}
