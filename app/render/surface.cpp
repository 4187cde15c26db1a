#include "render/surface.h"

#include "fields/image.h"
#include "fields/refine.h"
#include "fields/state_data.h"
#include "parallel.h"
#include "render/filter_output.h"
#include "render/labels.h"
#include "render/occlusion.h"
#include "render/render.h"
#include "scene/densities.h"

#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMembraneSurface.h>
#include <vtkNew.h>
#include <vtkPhaseBoundary.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace lamella::render {
namespace {

/// Cells of the refined lattice along the half-diagonal of the shape's bounding box: facets then
/// cannot be seen.
constexpr int fine_cells = 90;
constexpr int largest_refinement = 4;

/// What a filter warns of does not matter to a picture.
vtkSmartPointer<vtkPolyData> drawn_output_of(vtkPolyDataAlgorithm& filter, vtkImageData& image) {
  FilterOutput output = output_of(filter, image);
  if (!output.error.empty()) throw RenderError(output.error);
  return output.data;
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

void add_occlusion(vtkPolyData& mesh, const Frame& frame, double radius) {
  const Occlusion occlusion(crop(frame, 2 * radius + 4 * frame.grid.spacing), radius);
  auto* normals = vtkFloatArray::SafeDownCast(mesh.GetPointData()->GetNormals());
  vtkNew<vtkFloatArray> shade;
  shade->SetName("occlusion");
  shade->SetNumberOfTuples(mesh.GetNumberOfPoints());
  const float* const normal = normals->GetPointer(0);
  float* const out = shade->GetPointer(0);
  parallel_for(std::size_t(mesh.GetNumberOfPoints()), 1024,
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t n = begin; n < end; ++n) {
                   Vec3 p;
                   mesh.GetPoints()->GetPoint(vtkIdType(n), p.data());
                   const float* const m = normal + 3 * n;
                   out[n] = float(occlusion.at(p, {m[0], m[1], m[2]}));
                 }
               });
  mesh.GetPointData()->AddArray(shade);
}

Surface extract(vtkImageData& image, const Frame& frame, bool with_curvatures) {
  const double size = half_size(frame);
  if (size == 0)
    throw RenderError("nothing to draw: the level set at t = " + plain(number(frame.time)) +
                      " has no membrane");
  const double wanted = fine_cells * frame.grid.spacing / size;
  vtkNew<vtkMembraneSurface> membrane;
  membrane->SetRefinement(std::clamp(int(std::ceil(wanted)), 1, largest_refinement));
  membrane->SetComputeCurvatures(with_curvatures);
  Surface surface{frame.time, drawn_output_of(*membrane, image), {}, nullptr};
  add_occlusion(*surface.mesh, frame, 0.12 * size);
  surface.parts = patches(*surface.mesh);
  if (frame.has("psi")) surface.boundary = drawn_output_of(*vtkNew<vtkPhaseBoundary>(), image);
  return surface;
}

/// In the unit of pictures.
void scale(vtkPolyData& mesh, const std::string& name, const Units& units) {
  vtkDataArray* values = mesh.GetPointData()->GetArray(name.c_str());
  const Notation notation = notation_on_membrane(name);
  for (vtkIdType n = 0; n < values->GetNumberOfTuples(); ++n)
    values->SetComponent(n, 0, notation.value(values->GetComponent(n, 0), units));
}

/// The velocity's component along the normal, in place of the vector.
void project_velocity(vtkPolyData& mesh) {
  vtkDataArray* vectors = mesh.GetPointData()->GetArray("velocity");
  vtkDataArray* normals = mesh.GetPointData()->GetNormals();
  vtkNew<vtkDoubleArray> speed;
  speed->SetName("velocity");
  speed->SetNumberOfTuples(mesh.GetNumberOfPoints());
  for (vtkIdType n = 0; n < mesh.GetNumberOfPoints(); ++n) {
    const double* v = vectors->GetTuple3(n);
    const Vec3 velocity{v[0], v[1], v[2]};
    const double* normal = normals->GetTuple3(n);
    speed->SetValue(n, velocity[0] * normal[0] + velocity[1] * normal[1] + velocity[2] * normal[2]);
  }
  mesh.GetPointData()->AddArray(speed);
}

} // namespace

/// "K_m" is K_M mistyped; k may be a field.
bool is_quantity(std::string_view name) {
  const auto lower = [](unsigned char c) { return std::tolower(c); };
  const auto is_mistyped = [&](std::string_view known) {
    return name.size() > 1 && std::ranges::equal(name, known, {}, lower, lower);
  };
  return std::ranges::count(quantity_names, name) > 0 ||
         (is_name_to_give(name) && std::ranges::none_of(quantity_names, is_mistyped));
}

Surface extract_surface(const Frame& frame) {
  vtkNew<vtkImageData> image;
  fill_image(*image, frame);
  return extract(*image, frame, false);
}

Surface extract_surface(const State& state, const Quantity& quantity) {
  if (quantity == Quantity::phase) {
    Surface surface = extract_surface(state.frame);
    surface.units = Units(state.scene);
    return surface;
  }
  vtkNew<vtkImageData> image;
  fill_state(*image, state.frame, state.measures, state.scene, state.vesicles);
  Surface surface = extract(*image, state.frame, quantity != Quantity::c);
  const std::string& name = quantity.name;
  if (!surface.mesh->GetPointData()->HasArray(name.c_str()))
    throw RenderError(
        "colours of " + name +
        " need a field that the run does not have; c needs [stretch] modulus above 0, velocity one "
        "vesicle, or several that hold volume and area together, others one of [[fields]]");
  if (quantity == Quantity::velocity) project_velocity(*surface.mesh);
  surface.units = Units(state.scene);
  scale(*surface.mesh, name, surface.units);
  return surface;
}

} // namespace lamella::render
