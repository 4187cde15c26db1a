#include "render/membrane_view.h"

#include "parallel.h"
#include "render/phases.h"
#include "render/style.h"

#include <vtkActor.h>
#include <vtkBoundingBox.h>
#include <vtkCamera.h>
#include <vtkClipPolyData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkStripper.h>
#include <vtkTubeFilter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace lamella::render {
namespace {

double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// A distant light, from a direction in view axes: right, up, toward the eye.
struct Light {
  Vec3 from;
  double intensity;
};

Light light(const Vec3& from, double intensity) {
  const double length = std::hypot(from[0], from[1], from[2]);
  return {{from[0] / length, from[1] / length, from[2] / length}, intensity};
}

const std::array lights{light({-0.45, 0.80, 0.65}, 0.68),  // key, from the upper left
                        light({0.75, 0.10, 0.65}, 0.30),   // fill, from the right
                        light({0.05, -0.70, 0.40}, 0.22)}; // as paper would reflect, from below

/// What a matte surface sends to the eye: of its colour, and of white.
struct Brightness {
  double color, white;
};

/// Phong's model, at a normal in view axes.
Brightness brightness(const Vec3& normal) {
  constexpr double ambient = 0.44, diffuse = 0.72, specular = 0.07;
  Brightness sum{ambient, 0};
  for (const auto& [from, intensity] : lights) {
    const double lit = dot(normal, from);
    if (lit <= 0) continue;
    const double mirrored = std::max(0.0, 2 * lit * normal[2] - from[2]);
    const double cubed = mirrored * mirrored * mirrored; // the ninth power makes it matte
    sum.color += diffuse * intensity * lit;
    sum.white += specular * intensity * cubed * cubed * cubed;
  }
  return sum;
}

/// Where a mesh with normals faces the eye: 1 where straight, less than 0 where not.
vtkSmartPointer<vtkFloatArray> facing(vtkPolyData& mesh, const Vec3& toward_eye) {
  auto* normals = vtkFloatArray::SafeDownCast(mesh.GetPointData()->GetNormals());
  auto cosine = vtkSmartPointer<vtkFloatArray>::New();
  cosine->SetNumberOfTuples(mesh.GetNumberOfPoints());
  const float* normal = normals->GetPointer(0);
  for (vtkIdType n = 0; n < mesh.GetNumberOfPoints(); ++n, normal += 3)
    cosine->SetValue(n, float(dot({normal[0], normal[1], normal[2]}, toward_eye)));
  return cosine;
}

/// A colour in less light. Its strongest channel fades least: shadows of red stay warm.
Color shaded(const Color& color, double light) {
  const int strongest = std::max({color.r, color.g, color.b});
  const double longest_lit = std::pow(light, 0.8);
  const auto channel = [&](int value) {
    return static_cast<unsigned char>(value * (value == strongest ? longest_lit : light));
  };
  return {channel(color.r), channel(color.g), channel(color.b)};
}

/// The colour of a point in full light.
using Paint = std::function<Color(vtkIdType)>;

Color lit(const Color& color, const Brightness& brightness) {
  const auto channel = [&](int value) {
    const double sent = value * brightness.color + 255 * brightness.white;
    return static_cast<unsigned char>(std::min(255.0, sent + 0.5));
  };
  return {channel(color.r), channel(color.g), channel(color.b)};
}

/// The membrane's colour as seen at every point: darker where little ambient light comes in, and
/// toward the rim, which sets the shape off against the white paper. Between points of a mesh this
/// fine colours are linear; to light every sample of a picture takes OpenGL in software as long as
/// all the rest.
vtkSmartPointer<vtkUnsignedCharArray> tone(vtkPolyData& mesh, const Paint& paint,
                                           const Viewpoint& viewpoint) {
  auto* normals = vtkFloatArray::SafeDownCast(mesh.GetPointData()->GetNormals());
  auto* occlusion = vtkFloatArray::SafeDownCast(mesh.GetPointData()->GetArray("occlusion"));
  auto colors = vtkSmartPointer<vtkUnsignedCharArray>::New();
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(mesh.GetNumberOfPoints());
  const float* const normal = normals->GetPointer(0);
  unsigned char* const out = colors->GetPointer(0);
  const Vec3 toward_eye = viewpoint.lift({0, 0, 1});
  parallel_for(std::size_t(mesh.GetNumberOfPoints()), 1024,
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t n = begin; n < end; ++n) {
                   const Vec3 m{normal[3 * n], normal[3 * n + 1], normal[3 * n + 2]};
                   const auto [right, up] = viewpoint.project(m);
                   const double facing = dot(m, toward_eye);
                   const double away = 1 - std::clamp(facing, 0.0, 1.0);
                   const double open = 1 - 0.5 * occlusion->GetValue(vtkIdType(n));
                   const double light = open * (1 - 0.18 * away * away * away);
                   const Color seen =
                       lit(shaded(paint(vtkIdType(n)), light), brightness({right, up, facing}));
                   out[3 * n] = seen.r, out[3 * n + 1] = seen.g, out[3 * n + 2] = seen.b;
                 }
               });
  return colors;
}

vtkSmartPointer<vtkActor> membrane_actor(vtkPolyData& mesh, const Paint& paint,
                                         const Viewpoint& viewpoint) {
  vtkNew<vtkPolyData> toned;
  toned->CopyStructure(&mesh);
  toned->GetPointData()->SetScalars(tone(mesh, paint, viewpoint));
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(toned);
  mapper->SetColorModeToDirectScalars();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  return actor;
}

void add_membrane(vtkRenderer& renderer, const Surface& surface, const Coloring& coloring,
                  const Viewpoint& viewpoint) {
  if (coloring.quantity == Quantity::phase) {
    for (const Patch& patch : surface.parts) {
      const Color color = hue(patch.part).surface;
      const Paint paint = [=](vtkIdType) { return color; };
      renderer.AddActor(membrane_actor(*patch.mesh, paint, viewpoint));
    }
    return;
  }
  const std::string& name = coloring.quantity.name;
  vtkDataArray* values = surface.mesh->GetPointData()->GetArray(name.c_str());
  const Paint paint = [&](vtkIdType n) { return coloring.palette->at(values->GetComponent(n, 0)); };
  renderer.AddActor(membrane_actor(*surface.mesh, paint, viewpoint));
}

/// Radius of the thread along a boundary: constant, but less toward the horizon, over which the
/// thread would stick out, and less than 0 beyond.
vtkSmartPointer<vtkFloatArray> radius(vtkPolyData& boundary, const Vec3& toward_eye, double width) {
  constexpr float oblique = 0.35F;
  const auto out = facing(boundary, toward_eye);
  for (vtkIdType n = 0; n < out->GetNumberOfTuples(); ++n)
    out->SetValue(n, float(width / 2) * std::min(1.0F, out->GetValue(n) / oblique));
  return out;
}

/// A thread in the membrane rather than a line on it: nothing lies in the very same place, and seen
/// from the side it stays more than half as wide.
vtkSmartPointer<vtkActor> boundary_actor(vtkPolyData& lines, const Vec3& toward_eye, double width) {
  vtkNew<vtkPolyData> boundary;
  boundary->ShallowCopy(&lines);
  boundary->GetPointData()->SetScalars(radius(*boundary, toward_eye, width));
  vtkNew<vtkClipPolyData> front;
  front->SetInputData(boundary);
  front->SetValue(width / 100); // thinner, it cannot be seen
  vtkNew<vtkStripper> chain;
  chain->SetInputConnection(front->GetOutputPort());
  chain->JoinContiguousSegmentsOn();
  chain->SetMaximumLength(1 << 24);
  vtkNew<vtkTubeFilter> thread;
  thread->SetInputConnection(chain->GetOutputPort());
  thread->SetVaryRadiusToVaryRadiusByAbsoluteScalar();
  thread->SetNumberOfSides(12);
  thread->CappingOn();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(thread->GetOutputPort());
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(style::ink.r / 255.0, style::ink.g / 255.0, style::ink.b / 255.0);
  return actor;
}

} // namespace

void Extent::include(const Vec2& p) {
  for (int a = 0; a < 2; ++a) low[a] = std::min(low[a], p[a]), high[a] = std::max(high[a], p[a]);
}

void Extent::include(const Extent& other) {
  include(other.low);
  include(other.high);
}

Viewpoint::Viewpoint(double elevation, double azimuth) {
  constexpr double degree = std::numbers::pi / 180;
  const double c = std::cos(azimuth * degree), s = std::sin(azimuth * degree);
  const double level = std::cos(elevation * degree), rise = std::sin(elevation * degree);
  right_ = {c, s, 0};
  up_ = {-s * rise, c * rise, level};
  toward_eye_ = {s * level, -c * level, rise};
}

double suitable_elevation(const std::vector<Surface>& surfaces) {
  constexpr double oblique = 30, nearly_level = 12;
  vtkBoundingBox box;
  for (const Surface& surface : surfaces) box.AddBounds(surface.mesh->GetBounds());
  const bool tall = box.GetLength(2) > 1.2 * std::max(box.GetLength(0), box.GetLength(1));
  return tall ? nearly_level : oblique;
}

Vec2 Viewpoint::project(const Vec3& p) const { return {dot(p, right_), dot(p, up_)}; }

Vec3 Viewpoint::lift(const Vec3& view) const {
  Vec3 p{};
  for (int a = 0; a < 3; ++a)
    p[a] = view[0] * right_[a] + view[1] * up_[a] + view[2] * toward_eye_[a];
  return p;
}

Extent view_extent(const Surface& surface, const Viewpoint& viewpoint) {
  Extent extent;
  for (vtkIdType n = 0; n < surface.mesh->GetNumberOfPoints(); ++n) {
    Vec3 p;
    surface.mesh->GetPoint(n, p.data());
    extent.include(viewpoint.project(p));
  }
  return extent;
}

vtkSmartPointer<vtkRenderer> membrane_view(const Surface& surface, const Viewpoint& viewpoint,
                                           const Vec2& center, double height, double line_width,
                                           const Coloring& coloring) {
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->AutomaticLightCreationOff(); // colours have their light
  add_membrane(*renderer, surface, coloring, viewpoint);
  const Vec3 toward_eye = viewpoint.lift({0, 0, 1});
  if (surface.boundary && surface.boundary->GetNumberOfLines() > 0)
    renderer->AddActor(boundary_actor(*surface.boundary, toward_eye, line_width));

  vtkCamera* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(height / 2);
  camera->SetFocalPoint(viewpoint.lift({center[0], center[1], 0}).data());
  // Far enough for nothing to come near the camera, where VTK would cut it away.
  camera->SetPosition(viewpoint.lift({center[0], center[1], 10 * height}).data());
  camera->SetViewUp(viewpoint.lift({0, 1, 0}).data());
  renderer->ResetCameraClippingRange();
  return renderer;
}

} // namespace lamella::render
