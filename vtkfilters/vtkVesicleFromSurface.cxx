#include "vtkVesicleFromSurface.h"

#include "fields/image.h"
#include "fields/mesh.h"
#include "fields/report.h"
#include "fields/serve.h"
#include "fields/smooth.h"
#include "scene/scene.h"

#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <fmt/format.h>

vtkStandardNewMacro(vtkVesicleFromSurface);

namespace
{
constexpr double Filling = 0.7; // of the box by a surface that is scaled
constexpr double Clearance = 3; // spacings that the solver keeps free at the sides of the box

lamella::Scene GridOnly(const int nodes[3], double halfWidth)
{
  lamella::Scene scene;
  std::copy_n(nodes, 3, scene.nodes.begin());
  scene.half_width = halfWidth;
  return scene;
}

/** Throws where a scene could not have this grid. */
lamella::Grid CheckedGrid(const int nodes[3], double halfWidth)
{
  lamella::Scene scene = GridOnly(nodes, halfWidth);
  scene.shape = { .kind = lamella::ShapeKind::frame, .file = "none" }; // fits any grid
  lamella::validate(scene);
  return scene.grid();
}

double ShortestSide(const lamella::Grid& grid)
{
  return grid.spacing * *std::min_element(grid.nodes.begin(), grid.nodes.end());
}

std::string RemedyFor(bool scaled)
{
  return fmt::format(
    "{}choose more Nodes or less Smoothing", scaled ? "" : "switch ScaleToBox on, ");
}

/** Leaves out what the grid cannot carry; throws where that is all. */
void DropSmallParts(lamella::PartedMesh& mesh, double smoothing, const lamella::Grid& grid,
  bool scaled, std::string& remark)
{
  const double h = grid.spacing, least = lamella::least_volume(smoothing) * h * h * h;
  double largest = 0;
  for (const lamella::Part& part : mesh.parts)
  {
    largest = std::max(largest, part.volume);
  }
  lamella::drop_small_parts(mesh, least, remark);
  if (mesh.parts.empty())
  {
    throw lamella::InputError(fmt::format(
      "the surface is too small for the grid: the largest of its parts encloses as much as a ball "
      "of radius {:.3g}, and {:.3g} is the least; {}, or, where small parts are far from it, take "
      "the largest alone (vtkPolyDataConnectivityFilter with SetExtractionModeToLargestRegion())",
      lamella::radius_of(largest), lamella::radius_of(least), RemedyFor(scaled)));
  }
}

void CheckFits(const lamella::Mesh& mesh, const lamella::Grid& grid)
{
  const auto [low, high] = lamella::bounds_of(mesh);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double side = 0.5 * grid.length(axis) - Clearance * grid.spacing;
    if (low[axis] < -side || high[axis] > side)
    {
      throw lamella::InputError(
        fmt::format("the surface goes from {:.4g} to {:.4g} along {}, the box leaves room from "
                    "{:.4g} to {:.4g}; switch ScaleToBox on, or choose another HalfWidth",
          low[axis], high[axis], "xyz"[axis], -side, side));
    }
  }
}
}

int vtkVesicleFromSurface::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

/** Nonsense is refused with the data. */
int vtkVesicleFromSurface::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* output)
{
  lamella::offer_grid(
    *output->GetInformationObject(0), GridOnly(this->Nodes, this->HalfWidth).grid());
  return 1;
}

int vtkVesicleFromSurface::RequestData(
  vtkInformation*, vtkInformationVector** input, vtkInformationVector* output)
{
  return lamella::reporting(this,
    [&]
    {
      const lamella::Grid grid = CheckedGrid(this->Nodes, this->HalfWidth);
      std::string remark;
      lamella::Mesh closed = lamella::closed_mesh_of(*vtkPolyData::GetData(input[0]), remark);
      lamella::check_crossings(closed);
      if (this->ScaleToBox)
      {
        lamella::scale(closed, Filling * ShortestSide(grid));
      }
      lamella::PartedMesh mesh = lamella::parted(std::move(closed));
      DropSmallParts(mesh, this->Smoothing, grid, this->ScaleToBox, remark);
      CheckFits(mesh.mesh, grid);
      this->UpdateProgress(0.2);
      auto [phi, nearest] = lamella::signed_distance(mesh, grid);
      lamella::level_off(grid, phi);
      this->UpdateProgress(0.8);
      lamella::blur(grid, this->Smoothing, phi);
      lamella::keep_volumes(grid, mesh.parts, nearest, RemedyFor(this->ScaleToBox), phi, remark);
      lamella::remark(this, remark);
      lamella::fill_image(*vtkImageData::GetData(output), { .grid = grid, .phi = std::move(phi) });
    });
}

void vtkVesicleFromSurface::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Nodes: " << this->Nodes[0] << " " << this->Nodes[1] << " " << this->Nodes[2]
     << "\n";
  os << indent << "HalfWidth: " << this->HalfWidth << "\n";
  os << indent << "ScaleToBox: " << this->ScaleToBox << "\n";
  os << indent << "Smoothing: " << this->Smoothing << "\n";
}
