// Surfaces of triangles as level sets.
#include "fields/field_data.h"
#include "fields/measure.h"
#include "vtk_test.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkMembraneSurface.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkVesicleDynamics.h>
#include <vtkVesicleFromSurface.h>

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace lamella {
namespace {

using testing::HasSubstr;

const double pi = std::numbers::pi;

/// The triangles of an analytic shape.
vtkSmartPointer<vtkPolyData> mesh_of_shape(const Shape& shape, int nodes = 64) {
  vtkNew<vtkMembraneSurface> surface;
  surface->SetInputData(image_of(shape, nodes));
  surface->SetRefinement(1);
  surface->Update();
  return surface->GetOutput();
}

vtkSmartPointer<vtkVesicleFromSurface> vesicle_from(vtkPolyData* mesh) {
  auto vesicle = vtkSmartPointer<vtkVesicleFromSurface>::New();
  vesicle->SetInputData(mesh);
  return vesicle;
}

ShapeMeasures measures_of(vtkVesicleFromSurface* vesicle) {
  return measure(vesicle_in(*vesicle->GetOutput(), "phi").frame, {});
}

/// A mesh without some of its triangles, and others twice.
vtkSmartPointer<vtkPolyData> with_triangles(vtkPolyData* mesh, const auto& times) {
  vtkNew<vtkCellArray> cells;
  for (vtkIdType c = 0; c < mesh->GetNumberOfCells(); ++c) {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    mesh->GetPolys()->GetCellAtId(c, count, ids);
    for (int n = 0; n < times(c); ++n) cells->InsertNextCell(count, ids);
  }
  auto out = vtkSmartPointer<vtkPolyData>::New();
  out->SetPoints(mesh->GetPoints());
  out->SetPolys(cells);
  return out;
}

/// Two meshes as one, the second one moved.
vtkSmartPointer<vtkPolyData> both(vtkPolyData* first, vtkPolyData* second, const Vec3& by) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (vtkPolyData* mesh : {first, second}) {
    const vtkIdType begin = points->GetNumberOfPoints();
    const double sign = mesh == second ? 1 : 0;
    for (vtkIdType n = 0; n < mesh->GetNumberOfPoints(); ++n) {
      const double* p = mesh->GetPoint(n);
      points->InsertNextPoint(p[0] + sign * by[0], p[1] + sign * by[1], p[2] + sign * by[2]);
    }
    for (vtkIdType c = 0; c < mesh->GetNumberOfCells(); ++c) {
      vtkIdType count = 0;
      const vtkIdType* ids = nullptr;
      mesh->GetPolys()->GetCellAtId(c, count, ids);
      cells->InsertNextCell({begin + ids[0], begin + ids[1], begin + ids[2]});
    }
  }
  auto out = vtkSmartPointer<vtkPolyData>::New();
  out->SetPoints(points);
  out->SetPolys(cells);
  return out;
}

TEST(VesicleFromSurface, KeepsAShape) {
  const Shape shape{.kind = ShapeKind::ellipsoid,
                    .semi_axes = {0.7, 0.5, 0.4},
                    .center = {0.05, 0, -0.1},
                    .rotation_axis = {1, 1, 0},
                    .rotation_angle = 30};
  const auto vesicle = vesicle_from(mesh_of_shape(shape));
  EXPECT_EQ(error_of(vesicle), "");
  const ShapeMeasures m = measures_of(vesicle);
  EXPECT_NEAR(m.volume / exact_volume(shape), 1, 4e-3) << "facets lie inside";
  EXPECT_NEAR(m.area / exact_area(shape), 1, 5e-3);
  EXPECT_EQ(m.components, 1);
  EXPECT_EQ(m.genus, 0);
  vtkNew<vtkMembraneSurface> surface;
  surface->SetInputConnection(vesicle->GetOutputPort());
  surface->Update();
  vtkPolyData* mesh = surface->GetOutput();
  for (vtkIdType n = 0; n < mesh->GetNumberOfPoints(); ++n) {
    Vec3 p;
    mesh->GetPoint(n, p.data());
    EXPECT_NEAR(shape_function(shape, p), 0, 0.3 / 32) << "a third of a spacing";
  }
}

TEST(VesicleFromSurface, KeepsHandlesAndParts) {
  const Shape torus{.kind = ShapeKind::torus, .ring_radius = 0.5, .tube_radius = 0.2};
  const auto vesicle = vesicle_from(mesh_of_shape(torus));
  EXPECT_EQ(error_of(vesicle), "");
  EXPECT_EQ(measures_of(vesicle).genus, 1);
  EXPECT_NEAR(measures_of(vesicle).volume / exact_volume(torus), 1, 1e-2);
  const auto ball = mesh_of_shape(sphere(0.25));
  const auto pair = vesicle_from(both(mesh_of_shape(sphere(0.3, {0.4, 0, 0})), ball, {-0.4, 0, 0}));
  EXPECT_EQ(error_of(pair), "");
  EXPECT_EQ(measures_of(pair).components, 2);
  const auto shell = vesicle_from(both(mesh_of_shape(sphere(0.6)), ball, {0, 0, 0.1}));
  EXPECT_EQ(error_of(shell), "");
  EXPECT_NEAR(measures_of(shell).volume, 4. / 3 * pi * (std::pow(0.6, 3) - std::pow(0.25, 3)),
              5e-3);
}

TEST(VesicleFromSurface, DoesNotCareAboutWinding) {
  const auto mesh = mesh_of_shape(sphere(0.5));
  const auto usual = vesicle_from(mesh);
  usual->Update();
  vtkNew<vtkPolyData> turned;
  turned->DeepCopy(mesh);
  for (vtkIdType c = 0; c < turned->GetNumberOfCells(); ++c) turned->ReverseCell(c);
  const auto vesicle = vesicle_from(turned);
  EXPECT_EQ(error_of(vesicle), "");
  EXPECT_NEAR(measures_of(vesicle).volume, measures_of(usual).volume, 1e-6);
}

TEST(VesicleFromSurface, TakesACubeOfPolygons) {
  vtkNew<vtkPoints> points;
  for (int corner = 0; corner < 8; ++corner)
    points->InsertNextPoint(corner & 1 ? 6 : 4, corner & 2 ? 12 : 10, corner & 4 ? 2 : 0);
  vtkNew<vtkCellArray> sides;
  for (const auto& side : std::vector<std::array<vtkIdType, 4>>{
           {0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}})
    sides->InsertNextCell(4, side.data());
  vtkNew<vtkPolyData> cube;
  cube->SetPoints(points);
  cube->SetPolys(sides);
  const auto vesicle = vesicle_from(cube);
  EXPECT_THAT(error_of(vesicle), HasSubstr("along x, the box leaves room"));
  vesicle->ScaleToBoxOn();
  EXPECT_EQ(error_of(vesicle), "");
  const ShapeMeasures m = measures_of(vesicle);
  EXPECT_NEAR(m.volume, 1.4 * 1.4 * 1.4, 0.003);
  EXPECT_NEAR(m.area, 6 * 1.4 * 1.4, 0.6) << "rounded edges";
}

TEST(VesicleFromSurface, RelaxesToAVesicle) {
  const auto vesicle = vesicle_from(
      mesh_of_shape({.kind = ShapeKind::prolate, .semi_axis = 0.7, .reduced_volume = 0.8}));
  vesicle->SetNodes(32, 32, 32);
  vtkNew<vtkVesicleDynamics> dynamics;
  dynamics->SetInputConnection(vesicle->GetOutputPort());
  dynamics->SetEndTime(2e-4);
  dynamics->SetOutputFrames(2);
  const auto energy = [&](double time) {
    dynamics->UpdateTimeStep(time);
    return field_value(*dynamics->GetOutput(), "energy").value();
  };
  const double before = energy(0);
  EXPECT_LT(energy(2e-4), before);
}

TEST(VesicleFromSurface, SaysWhereASurfaceIsOpen) {
  const auto mesh = mesh_of_shape(sphere(0.5), 32);
  EXPECT_THAT(error_of(vesicle_from(with_triangles(mesh, [](vtkIdType c) { return c != 7; }))),
              HasSubstr("not closed: it has 1 hole, with 3 edges, one of them at ("));
  const vtkIdType last = mesh->GetNumberOfCells() - 1;
  EXPECT_THAT(error_of(vesicle_from(
                  with_triangles(mesh, [&](vtkIdType c) { return c != 7 && c != last; }))),
              HasSubstr("it has 2 holes, with 6 edges"));
  EXPECT_THAT(
      error_of(vesicle_from(with_triangles(mesh, [](vtkIdType c) { return c == 7 ? 2 : 1; }))),
      HasSubstr("3 edges are shared by more than two triangles"));
}

TEST(VesicleFromSurface, SaysWhereASurfaceCrossesItself) {
  const auto ball = mesh_of_shape(sphere(0.3), 32);
  const auto crossed = vesicle_from(both(ball, mesh_of_shape(sphere(0.3), 40), {0.4, 0.01, 0.02}));
  EXPECT_THAT(error_of(crossed), HasSubstr("the surface crosses itself"));
  EXPECT_THAT(error_of(crossed), HasSubstr("one of them at (0.2"));
  EXPECT_EQ(crossed->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(VesicleFromSurface, SaysWhatIsWrong) {
  vtkNew<vtkPolyData> empty;
  EXPECT_THAT(error_of(vesicle_from(empty)), HasSubstr("no triangles"));
  const auto broken = mesh_of_shape(sphere(0.5), 32);
  broken->GetPoints()->SetPoint(3, std::numeric_limits<double>::quiet_NaN(), 0, 0);
  EXPECT_THAT(error_of(vesicle_from(broken)), HasSubstr("not finite"));
  const auto mesh = mesh_of_shape(sphere(0.5), 32);
  const auto vesicle = vesicle_from(mesh);
  vesicle->SetNodes(50, 64, 64);
  EXPECT_THAT(error_of(vesicle), HasSubstr("[grid] nodes"));
  vesicle->SetNodes(64, 64, 64);
  vesicle->SetHalfWidth(-1);
  EXPECT_THAT(error_of(vesicle), HasSubstr("[grid] half_width"));
  vesicle->SetHalfWidth(0.4);
  EXPECT_THAT(error_of(vesicle), HasSubstr("switch ScaleToBox on"));
  vesicle->SetHalfWidth(200);
  EXPECT_THAT(error_of(vesicle), HasSubstr("encloses no node"));
  EXPECT_EQ(vesicle->GetOutput()->GetNumberOfPoints(), 0);
  vesicle->SetHalfWidth(1);
  EXPECT_EQ(error_of(vesicle), "");
}

} // namespace
} // namespace lamella
