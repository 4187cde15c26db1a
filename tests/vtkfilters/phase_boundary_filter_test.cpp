// The boundary of two phases as lines.
#include "bad_images.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkPhaseBoundary.h>

#include <Eigen/Geometry>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

namespace lamella {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

const double pi = std::numbers::pi;

template <class Psi>
Frame two_phases(const Shape& shape, const Grid& grid, Psi&& psi) {
  Frame frame = frame_of(shape, grid);
  for (std::size_t n = 0; n < grid.size(); ++n)
    frame.fields["psi"].push_back(psi(grid.position(n)));
  return frame;
}

vtkSmartPointer<vtkPolyData> boundary_of(vtkImageData* image) {
  vtkNew<vtkPhaseBoundary> boundary;
  boundary->SetInputData(image);
  boundary->Update();
  return boundary->GetOutput();
}

Vector3d place(vtkPolyData* lines, vtkIdType n) { return Vector3d(lines->GetPoint(n)); }

/// Circumference of an ellipse.
double ellipse(double a, double b) {
  constexpr int n = 1000;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * pi * i / n;
    sum += std::hypot(a * std::sin(angle), b * std::cos(angle)) * 2 * pi / n;
  }
  return sum;
}

double length(vtkPolyData* lines, vtkIdType cell) {
  return lines->GetCellData()->GetArray("length")->GetComponent(cell, 0);
}

TEST(PhaseBoundaryFilter, OfACapIsACircleWithLdToTheLeft) {
  const double R = 0.5, z0 = 0.3, r = std::sqrt(R * R - z0 * z0);
  const Frame frame =
      two_phases(sphere(R), Grid::cube(64, 1), [=](const Vec3& p) { return z0 - p[2]; });
  const auto lines = boundary_of(image_of(frame));
  ASSERT_EQ(lines->GetNumberOfCells(), 1);
  EXPECT_NEAR(length(lines, 0), 2 * pi * r, 1e-7);
  const vtkIdType points = lines->GetNumberOfPoints();
  vtkIdType count = 0;
  const vtkIdType* ids = nullptr;
  lines->GetLines()->GetCellAtId(0, count, ids);
  ASSERT_EQ(count, points + 1);
  EXPECT_EQ(ids[0], ids[points]);
  auto* normals = vtkFloatArray::SafeDownCast(lines->GetPointData()->GetNormals());
  for (vtkIdType n = 0; n < points; ++n) {
    const Vector3d x = place(lines, n), ahead = place(lines, (n + 1) % points) - x;
    EXPECT_EQ(ids[n], n);
    EXPECT_NEAR(std::hypot(x[0], x[1]), r, 1e-8);
    EXPECT_NEAR(x[2], z0, 1e-8);
    EXPECT_GT(ahead.dot(Vector3d(-x[1], x[0], 0)), 0) << "about z, the cap to the left";
    const Vector3d t(values_of(lines, "tangent") + 3 * n), N(normals->GetTuple(n));
    EXPECT_LT((t - Vector3d(-x[1], x[0], 0) / r).norm(), 1e-6);
    EXPECT_LT((N - x / R).norm(), 1e-6);
    EXPECT_NEAR(values_of(lines, "kg")[n], -z0 / (R * r), 1e-5);
    EXPECT_NEAR(values_of(lines, "kn")[n], -1 / R, 1e-5);
    EXPECT_NEAR(values_of(lines, "tau_g")[n], 0, 1e-5);
    EXPECT_NEAR(values_of(lines, "B_perp")[n], -1 / R, 1e-5);
    EXPECT_NEAR(values_of(lines, "arc_length")[n], 2 * pi * r * double(n) / double(points), 1e-5);
  }
}

TEST(PhaseBoundaryFilter, HasTheLengthOfPlanarCutsOfAnEllipsoid) {
  const Shape shape{.kind = ShapeKind::ellipsoid, .semi_axes = {0.7, 0.5, 0.4}};
  const auto cuts = [](const Vec3& p) { return std::abs(p[0] + 0.05) - 0.25; };
  const auto lines = boundary_of(image_of(two_phases(shape, Grid::cube(64, 1), cuts)));
  ASSERT_EQ(lines->GetNumberOfCells(), 2);
  for (int cell : {0, 1}) {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    lines->GetLines()->GetCellAtId(cell, count, ids);
    const double x = place(lines, ids[0])[0];
    EXPECT_NEAR(std::abs(x + 0.05), 0.25, 1e-6);
    const double scale = std::sqrt(1 - x * x / 0.49);
    EXPECT_NEAR(length(lines, cell) / ellipse(0.5 * scale, 0.4 * scale), 1, 1e-6);
  }
}

TEST(PhaseBoundaryFilter, LiesWhereTheImageLies) {
  const auto image = image_of(
      two_phases(sphere(0.5), Grid::cube(48, 1), [](const Vec3& p) { return 0.3 - p[2]; }));
  const Vector3d before = place(boundary_of(image), 0);
  image->SetOrigin(image->GetOrigin()[0] + 2, image->GetOrigin()[1], image->GetOrigin()[2] - 1);
  EXPECT_LT((place(boundary_of(image), 0) - before - Vector3d(2, 0, -1)).norm(), 1e-12);
}

TEST(PhaseBoundaryFilter, IsEmptyWhereOnePhaseHasAll) {
  vtkNew<vtkPhaseBoundary> boundary;
  boundary->SetInputData(
      image_of(two_phases(sphere(0.5), Grid::cube(32, 1), [](const Vec3&) { return 1.0; })));
  EXPECT_EQ(error_of(boundary), "");
  EXPECT_EQ(boundary->GetOutput()->GetNumberOfCells(), 0);
}

TEST(PhaseBoundaryFilter, SaysWhatItLeavesOut) {
  const auto saddle = [](const Vec3& p) {
    return p[0] * p[1] * 4;
  }; // lines that cross at the poles
  vtkNew<vtkPhaseBoundary> boundary;
  boundary->SetInputData(image_of(two_phases(sphere(0.5), Grid::cube(48, 1), saddle)));
  const Reports warnings(boundary, vtkCommand::WarningEvent);
  boundary->Update();
  EXPECT_THAT(warnings.text(), HasSubstr("(0, 0, "));
}

TEST(PhaseBoundaryFilter, SaysWhatIsWrongWithAnImage) {
  for (const BadImage& bad : bad_images()) {
    vtkNew<vtkPhaseBoundary> boundary;
    boundary->SetInputData(bad.image);
    EXPECT_THAT(error_of(boundary), HasSubstr(bad.complaint));
    EXPECT_EQ(boundary->GetOutput()->GetNumberOfPoints(), 0);
  }
  vtkNew<vtkPhaseBoundary> boundary;
  boundary->SetInputData(image_of(sphere(0.5), 32));
  EXPECT_THAT(error_of(boundary), HasSubstr("no point data array \"psi\""));
}

} // namespace
} // namespace lamella
