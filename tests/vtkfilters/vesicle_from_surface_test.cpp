// Surfaces of triangles as level sets.
#include "fields/field_data.h"
#include "fields/measure.h"
#include "vtk_test.h"

#include <vtkCellArray.h>
#include <vtkCleanPolyData.h>
#include <vtkFloatArray.h>
#include <vtkMembraneSurface.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkVesicleDynamics.h>
#include <vtkVesicleFromSurface.h>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <functional>
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

vtkSmartPointer<vtkVesicleFromSurface> vesicle_from(vtkPolyData* mesh, int nodes = 32) {
  auto vesicle = vtkSmartPointer<vtkVesicleFromSurface>::New();
  vesicle->SetInputData(mesh);
  vesicle->SetNodes(nodes, nodes, nodes);
  return vesicle;
}

ShapeMeasures measures_of(vtkVesicleFromSurface* vesicle) {
  return measure(vesicle_in(*vesicle->GetOutput(), {}).frame, {});
}

/// What a vesicle says it does to a surface.
std::string warning_of(vtkVesicleFromSurface* vesicle) {
  const Reports warnings(vesicle, vtkCommand::WarningEvent);
  EXPECT_EQ(error_of(vesicle), "");
  return warnings.text();
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

/// Polygons with their points.
vtkSmartPointer<vtkPolyData> polygons(const std::vector<Vec3>& points,
                                      const std::vector<std::vector<vtkIdType>>& sides) {
  auto out = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> vertices;
  vertices->SetDataTypeToDouble();
  for (const Vec3& p : points) vertices->InsertNextPoint(p.data());
  vtkNew<vtkCellArray> cells;
  for (const auto& side : sides) cells->InsertNextCell(vtkIdType(side.size()), side.data());
  out->SetPoints(vertices);
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
  const auto vesicle = vesicle_from(mesh_of_shape(shape), 64);
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
  const auto vesicle = vesicle_from(cube, 64);
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
  EXPECT_THAT(error_of(vesicle_from(broken)), HasSubstr("not finite: point 3 is (nan, 0, 0)"));
  const auto unused = mesh_of_shape(sphere(0.5), 32);
  unused->GetPoints()->InsertNextPoint(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  EXPECT_EQ(error_of(vesicle_from(unused)), "");
  EXPECT_THAT(error_of(vesicle_from(polygons({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                                             {{0, 1, 2}, {0, 2, 3}, {0, 1, 3}, {1, 2, 3}}))),
              HasSubstr("the surface is flat"));
  EXPECT_THAT(error_of(vesicle_from(polygons({{0, 0, 0}}, {{0, 1, 2}}))),
              HasSubstr("the surface has no point 1"));
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
  EXPECT_THAT(error_of(vesicle), HasSubstr("too small for the grid"));
  EXPECT_EQ(vesicle->GetOutput()->GetNumberOfPoints(), 0);
  vesicle->SetHalfWidth(1);
  EXPECT_EQ(error_of(vesicle), "");
  vesicle->SetHalfWidth(200);
  vesicle->ScaleToBoxOn();
  EXPECT_EQ(error_of(vesicle), "");
}

/// Each triangle with points of its own, moved by up to a distance.
vtkSmartPointer<vtkPolyData> soup(vtkPolyData* mesh, double distance) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  unsigned state = 1;
  const auto random = [&] { // -1 .. 1
    state = 1664525 * state + 1013904223;
    return 2 * (state / 4294967296.0) - 1;
  };
  for (vtkIdType c = 0; c < mesh->GetNumberOfCells(); ++c) {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    mesh->GetPolys()->GetCellAtId(c, count, ids);
    std::array<vtkIdType, 3> corners;
    for (int n = 0; n < 3; ++n) {
      const double* p = mesh->GetPoint(ids[n]);
      corners[n] = points->InsertNextPoint(p[0] + distance * random(), p[1] + distance * random(),
                                           p[2] + distance * random());
    }
    cells->InsertNextCell(3, corners.data());
  }
  auto out = vtkSmartPointer<vtkPolyData>::New();
  out->SetPoints(points);
  out->SetPolys(cells);
  return out;
}

/// Adds a box to points and sides.
void add_box(const Vec3& low, const Vec3& high, std::vector<Vec3>& points,
             std::vector<std::vector<vtkIdType>>& sides) {
  const vtkIdType n = vtkIdType(points.size());
  for (int corner = 0; corner < 8; ++corner)
    points.push_back({corner & 1 ? high[0] : low[0], corner & 2 ? high[1] : low[1],
                      corner & 4 ? high[2] : low[2]});
  for (const auto& side : std::vector<std::array<vtkIdType, 4>>{
           {0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}})
    sides.push_back({n + side[0], n + side[1], n + side[2], n + side[3]});
}

vtkSmartPointer<vtkPolyData> boxes(const std::vector<std::pair<Vec3, Vec3>>& corners) {
  std::vector<Vec3> points;
  std::vector<std::vector<vtkIdType>> sides;
  for (const auto& [low, high] : corners) add_box(low, high, points, sides);
  return polygons(points, sides);
}

double volume_of(vtkVesicleFromSurface* vesicle) { return measures_of(vesicle).volume; }

TEST(VesicleFromSurface, JoinsPointsThatNearlyMeet) {
  const auto mesh = mesh_of_shape(sphere(0.5), 32);
  const auto whole = vesicle_from(mesh), loose = vesicle_from(soup(mesh, 3e-7));
  EXPECT_EQ(warning_of(whole) + warning_of(loose), "");
  EXPECT_NEAR(volume_of(loose) / volume_of(whole), 1, 1e-5);
}

TEST(VesicleFromSurface, SaysHowToJoinPointsThatDoNotMeet) {
  const auto mesh = mesh_of_shape(sphere(0.5), 32), loose = soup(mesh, 3e-5);
  EXPECT_THAT(error_of(vesicle_from(loose)),
              HasSubstr("its points do not meet: vtkCleanPolyData with SetTolerance(0.0001)"));
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputData(loose);
  clean->SetTolerance(0.0001);
  clean->Update();
  const auto vesicle = vesicle_from(clean->GetOutput());
  EXPECT_EQ(error_of(vesicle), "");
  const auto whole = vesicle_from(mesh);
  whole->Update();
  EXPECT_NEAR(volume_of(vesicle) / volume_of(whole), 1, 1e-3);
}

// A side in two halves, and one in quarters that do not fit the others' edges.
TEST(VesicleFromSurface, DividesEdgesWhereCornersOfOthersLie) {
  std::vector<Vec3> points;
  std::vector<std::vector<vtkIdType>> sides;
  add_box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, points, sides);
  const auto add = [&](const Vec3& p) {
    points.push_back(p);
    return vtkIdType(points.size()) - 1;
  };
  const vtkIdType a = add({-0.5, 0.1, -0.5}), b = add({-0.5, 0.1 + 1e-8, 0.5});
  sides[4] = {0, a, b, 4}; // x = -0.5
  sides.push_back({a, 2, 6, b});
  const vtkIdType c = add({0.5, -0.5, 0}), d = add({0.5, 0, 0.5}), e = add({0.5, 0.5, 0.2}),
                  f = add({0.5, 0.1, -0.5}), m = add({0.5, 0, 0});
  sides[5] = {1, f, m, c}; // x = 0.5
  sides.push_back({f, 3, e, m});
  sides.push_back({m, e, 7, d});
  sides.push_back({c, m, d, 5});
  const auto vesicle = vesicle_from(polygons(points, sides));
  EXPECT_EQ(warning_of(vesicle), "");
  EXPECT_NEAR(volume_of(vesicle), 1, 1e-5);
}

TEST(VesicleFromSurface, TakesRepeatedTrianglesOnce) {
  const auto mesh = mesh_of_shape(sphere(0.5), 32);
  const auto whole = vesicle_from(mesh);
  whole->Update();
  const auto one = vesicle_from(with_triangles(mesh, [](vtkIdType c) { return c == 7 ? 2 : 1; }));
  EXPECT_THAT(warning_of(one),
              HasSubstr("1 triangle of the surface is there more than once: taken once"));
  EXPECT_NEAR(volume_of(one) / volume_of(whole), 1, 1e-9);
  const auto twice = with_triangles(mesh, [](vtkIdType) { return 2; });
  for (vtkIdType c = 0; c < twice->GetNumberOfCells(); c += 2) twice->ReverseCell(c);
  const auto all = vesicle_from(twice);
  EXPECT_THAT(warning_of(all), HasSubstr(std::to_string(mesh->GetNumberOfCells()) +
                                         " triangles of the surface are there more than once"));
  EXPECT_NEAR(volume_of(all) / volume_of(whole), 1, 1e-9);
}

TEST(VesicleFromSurface, LeavesOutWallsBetweenParts) {
  const auto vesicle = vesicle_from(
      boxes({{{-0.6, -0.3, -0.3}, {0, 0.3, 0.3}}, {{0, -0.3, -0.3}, {0.6, 0.3, 0.3}}}));
  EXPECT_THAT(warning_of(vesicle), HasSubstr("left out, as walls between its parts"));
  EXPECT_EQ(measures_of(vesicle).components, 1);
  EXPECT_NEAR(volume_of(vesicle), 1.2 * 0.6 * 0.6, 1e-5);
}

TEST(VesicleFromSurface, SaysWherePartsTouch) {
  const Vec3 low{-0.7, -0.7, -0.3}, middle{0, 0, 0.3}, other{0, 0, -0.3}, high{0.7, 0.7, 0.3};
  EXPECT_THAT(error_of(vesicle_from(boxes({{low, middle}, {other, high}}))),
              HasSubstr("the surface branches: 1 edge is shared by more than two triangles, one of "
                        "them at (0, 0, 0)"));
  const auto apart = vesicle_from(boxes({{low, middle}, {{0.15, 0.15, -0.3}, high}}));
  EXPECT_EQ(warning_of(apart), "");
  EXPECT_EQ(measures_of(apart).components, 2);
  EXPECT_NEAR(volume_of(apart), 0.6 * (0.49 + 0.55 * 0.55), 1e-5);
}

/// The volume of the inside where f is true.
template <class F>
double volume_where(vtkVesicleFromSurface* vesicle, F&& f) {
  Frame frame = vesicle_in(*vesicle->GetOutput(), {}).frame;
  for (std::size_t n = 0; n < frame.phi.size(); ++n)
    if (!f(frame.grid.position(n))) frame.phi[n] = std::abs(frame.phi[n]) + 1e-3;
  return measure(frame, {}).volume;
}

/// Of a closed mesh that is wound one way.
double exact_volume_of(vtkPolyData* mesh) {
  double volume = 0;
  for (vtkIdType c = 0; c < mesh->GetNumberOfCells(); ++c) {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    mesh->GetPolys()->GetCellAtId(c, count, ids);
    Vec3 p, q, r;
    mesh->GetPoint(ids[0], p.data());
    mesh->GetPoint(ids[1], q.data());
    mesh->GetPoint(ids[2], r.data());
    volume += (p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
               p[2] * (q[0] * r[1] - q[1] * r[0])) /
              6;
  }
  return volume;
}

TEST(VesicleFromSurface, KeepsTheVolumeOfEachPart) {
  const auto large = mesh_of_shape(sphere(0.4)), small = mesh_of_shape(sphere(0.12));
  const auto vesicle = vesicle_from(both(large, small, {0.6, 0.3, 0}), 64);
  EXPECT_EQ(warning_of(vesicle), "");
  const auto is_small = [](const Vec3& p) {
    return std::hypot(p[0] - 0.6, p[1] - 0.3, p[2]) < 0.2;
  };
  EXPECT_NEAR(volume_where(vesicle, is_small) / exact_volume_of(small), 1, 1e-3);
  EXPECT_NEAR(volume_where(vesicle, std::not_fn(is_small)) / exact_volume_of(large), 1, 1e-4);
}

TEST(VesicleFromSurface, LeavesOutDebris) {
  const auto large = mesh_of_shape(sphere(0.5)), speck = mesh_of_shape(sphere(0.25), 16);
  vtkNew<vtkPolyData> small;
  small->DeepCopy(speck);
  for (vtkIdType n = 0; n < small->GetNumberOfPoints(); ++n) {
    const double* p = speck->GetPoint(n);
    small->GetPoints()->SetPoint(n, 0.1 * p[0], 0.1 * p[1], 0.1 * p[2]);
  }
  vtkSmartPointer<vtkPolyData> mesh = large;
  for (int n = 0; n < 20; ++n)
    mesh = both(mesh, small, {0.7 * std::cos(n), 0.7 * std::sin(n), 0.03 * n - 0.3});
  mesh = both(mesh, small, {2, 0, 0}); // beyond the box
  const auto vesicle = vesicle_from(mesh);
  EXPECT_THAT(warning_of(vesicle),
              HasSubstr("21 of the surface's 22 parts are too small for the grid and left out: the "
                        "largest of them is a ball of radius 0.02"));
  EXPECT_NEAR(volume_of(vesicle) / exact_volume_of(large), 1, 1e-6);
  EXPECT_EQ(measures_of(vesicle).components, 1);
}

TEST(VesicleFromSurface, RefusesWhatIsTooThinForTheGrid) {
  const auto plate = boxes({{{-0.6, -0.6, -0.02}, {0.6, 0.6, 0.02}}});
  const auto vesicle = vesicle_from(plate);
  EXPECT_THAT(error_of(vesicle), HasSubstr("too thin for the grid"));
  EXPECT_THAT(error_of(vesicle), HasSubstr("choose more Nodes or less Smoothing"));
  EXPECT_EQ(vesicle->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(VesicleFromSurface, RefusesPartsThatTheGridWouldJoin) {
  const auto pair =
      boxes({{{-0.6, -0.3, -0.3}, {-0.01, 0.3, 0.3}}, {{0.01, -0.3, -0.3}, {0.6, 0.3, 0.3}}});
  const auto vesicle = vesicle_from(pair);
  vesicle->SetNodes(32, 32, 32);
  EXPECT_THAT(error_of(vesicle), HasSubstr("too near each other: of 2 there would be 1; "));
}

// Half of a ball of few triangles, half of very many: neither time nor memory go with their ratio.
TEST(VesicleFromSurface, TakesTrianglesOfVeryDifferentSizes) {
  const auto divided = [](vtkPolyData* mesh, double from, int times) {
    auto out = mesh_of_shape(sphere(0.5), 16);
    out->DeepCopy(mesh);
    for (int n = 0; n < times; ++n) {
      vtkNew<vtkCellArray> cells;
      for (vtkIdType c = 0; c < out->GetNumberOfCells(); ++c) {
        vtkIdType count = 0;
        const vtkIdType* ids = nullptr;
        out->GetPolys()->GetCellAtId(c, count, ids);
        const std::array<vtkIdType, 3> t{ids[0], ids[1], ids[2]};
        Vec3 middle{};
        for (const vtkIdType id : t)
          for (int a = 0; a < 3; ++a) middle[a] += out->GetPoint(id)[a] / 3;
        if (middle[0] < from) {
          cells->InsertNextCell(3, t.data());
          continue;
        }
        const vtkIdType m = out->GetPoints()->InsertNextPoint(middle.data());
        for (int e = 0; e < 3; ++e) cells->InsertNextCell({t[e], t[(e + 1) % 3], m});
      }
      out->SetPolys(cells);
    }
    return out;
  };
  const auto coarse = mesh_of_shape(sphere(0.5), 16);
  const auto fine = vesicle_from(divided(coarse, 0.4, 5));
  EXPECT_EQ(warning_of(fine), "");
  EXPECT_NEAR(volume_of(fine) / exact_volume_of(coarse), 1, 1e-6);
}

/// A solid of revolution around an axis that is no axis of the grid.
vtkSmartPointer<vtkPolyData> turned_lathe(const std::vector<std::array<double, 2>>& profile,
                                          int slivers) {
  const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  std::vector<Vec3> points;
  std::vector<std::vector<vtkIdType>> sides;
  const auto add = [&](double r, double z, double angle) {
    const Eigen::Vector3d p = turn * Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), z);
    points.push_back({p[0], p[1], p[2]});
  };
  add(0, profile.front()[1], 0);
  add(0, profile.back()[1], 0);
  for (const auto& [r, z] : profile)
    for (int n = 0; n < slivers; ++n) add(r, z, 2 * pi * n / slivers);
  const auto at = [&](std::size_t ring, int n) {
    return vtkIdType(2 + ring * slivers + n % slivers);
  };
  for (int n = 0; n < slivers; ++n) {
    sides.push_back({0, at(0, n + 1), at(0, n)});
    sides.push_back({1, at(profile.size() - 1, n), at(profile.size() - 1, n + 1)});
    for (std::size_t ring = 0; ring + 1 < profile.size(); ++ring) {
      sides.push_back({at(ring, n), at(ring, n + 1), at(ring + 1, n)});
      sides.push_back({at(ring, n + 1), at(ring + 1, n + 1), at(ring + 1, n)});
    }
  }
  return polygons(points, sides);
}

// Lids of fans, sides of strips: the bounds of each sliver meet those of very many others. With
// boxes along the axes of the grid this took minutes, and four times as much for twice as many.
TEST(VesicleFromSurface, TakesFansAndStripsOfSlivers) {
  const auto can = vesicle_from(turned_lathe({{0.5, -0.4}, {0.5, 0.4}}, 30000));
  EXPECT_EQ(warning_of(can), "");
  EXPECT_NEAR(volume_of(can) / (pi * 0.25 * 0.8), 1, 1e-5);
  const auto crossed =
      vesicle_from(both(turned_lathe({{0.5, -0.4}, {0.5, 0.4}}, 3000),
                        turned_lathe({{0.2, -0.1}, {0.2, 0.1}}, 50), {0.5, 0.01, 0.02}));
  EXPECT_THAT(error_of(crossed), HasSubstr("the surface crosses itself"));
}

// Where a point lies on a line of nodes, or an edge along one, the inside does not leak.
TEST(VesicleFromSurface, TakesSurfacesThatLieOnNodes) {
  const double h = 1. / 32;
  std::vector<Vec3> points;
  std::vector<std::vector<vtkIdType>> sides;
  add_box({-15.5 * h, -10.5 * h, -12.5 * h}, {15.5 * h, 10.5 * h, 12.5 * h}, points, sides);
  const auto box = vesicle_from(polygons(points, sides));
  EXPECT_EQ(warning_of(box), "");
  EXPECT_NEAR(volume_of(box) / (31 * 21 * 25 * h * h * h), 1, 1e-6);
  const double m = 0.5 * h, low = m - 16 * h, high = m + 16 * h;
  const auto octahedron = vesicle_from(polygons(
      {{high, m, m}, {low, m, m}, {m, high, m}, {m, low, m}, {m, m, high}, {m, m, low}},
      {{0, 2, 4}, {0, 2, 5}, {0, 3, 4}, {0, 3, 5}, {1, 2, 4}, {1, 2, 5}, {1, 3, 4}, {1, 3, 5}}));
  EXPECT_EQ(warning_of(octahedron), "");
  EXPECT_NEAR(volume_of(octahedron) / (4. / 3 * std::pow(16 * h, 3)), 1, 1e-6);
}

// In units of a nanometre in metres, of kilometres, and far from the origin.
TEST(VesicleFromSurface, TakesAnyUnitWhereItIsScaled) {
  const auto mesh = mesh_of_shape(sphere(0.5), 32);
  const auto plain = vesicle_from(mesh);
  plain->ScaleToBoxOn();
  plain->Update();
  for (const auto& [unit, away] : {std::pair{1e-9, 0.}, {1e9, 0.}, {1e-20, 0.}, {1., 1e6}}) {
    auto moved = soup(mesh, 0);
    for (vtkIdType n = 0; n < moved->GetNumberOfPoints(); ++n) {
      const Vec3 p{moved->GetPoint(n)[0], moved->GetPoint(n)[1], moved->GetPoint(n)[2]};
      moved->GetPoints()->SetPoint(n, unit * (p[0] + away), unit * (p[1] - away), unit * p[2]);
    }
    const auto vesicle = vesicle_from(moved);
    vesicle->ScaleToBoxOn();
    EXPECT_EQ(warning_of(vesicle), "");
    EXPECT_NEAR(volume_of(vesicle) / volume_of(plain), 1, 1e-6);
  }
  const auto beyond = soup(mesh, 0);
  beyond->GetPoints()->SetPoint(5, 1e200, 0, 0);
  EXPECT_THAT(error_of(vesicle_from(beyond)), HasSubstr("choose a unit in which it is about 1"));
}

} // namespace
} // namespace lamella
