#include "scene/scene_toml.h"
#include "scene/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <stdexcept>

namespace lamella {
namespace {

using std::numbers::pi;

Shape oblate(double a, double v) {
  return {.kind = ShapeKind::oblate, .semi_axis = a, .reduced_volume = v};
}
Shape prolate(double a, double v) {
  return {.kind = ShapeKind::prolate, .semi_axis = a, .reduced_volume = v};
}
Shape ellipsoid(Vec3 axes) { return {.kind = ShapeKind::ellipsoid, .semi_axes = axes}; }
Shape torus(double ring, double tube) {
  return {.kind = ShapeKind::torus, .ring_radius = ring, .tube_radius = tube};
}
Shape sphere(double radius) { return {.kind = ShapeKind::sphere, .radius = radius}; }

Shape moved(Shape shape) {
  shape.center = {0.1, -0.05, 0.02};
  shape.rotation_axis = {1, 2, -0.5};
  shape.rotation_angle = 37;
  return shape;
}

/// Rodrigues' rotation of a vector by the shape's angle, then the shift to its centre.
Vec3 placed(const Shape& shape, const Vec3& x) {
  const Vec3& n = shape.rotation_axis;
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  const double angle = shape.rotation_angle * pi / 180, c = std::cos(angle), s = std::sin(angle);
  const Vec3 u{n[0] / length, n[1] / length, n[2] / length};
  const double along = u[0] * x[0] + u[1] * x[1] + u[2] * x[2];
  const Vec3 cross{u[1] * x[2] - u[2] * x[1], u[2] * x[0] - u[0] * x[2], u[0] * x[1] - u[1] * x[0]};
  Vec3 y = shape.center;
  for (int i = 0; i < 3; ++i) y[i] += c * x[i] + s * cross[i] + (1 - c) * along * u[i];
  return y;
}

/// Points of the surface, spread at random.
std::vector<Vec3> surface_points(const Shape& shape, int count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(0, 2 * pi);
  std::vector<Vec3> points;
  for (int n = 0; n < count; ++n) {
    const double p = angle(random), q = angle(random);
    Vec3 x;
    if (shape.kind == ShapeKind::torus) {
      const double rho = shape.ring_radius + shape.tube_radius * std::cos(q);
      x = {rho * std::cos(p), rho * std::sin(p), shape.tube_radius * std::sin(q)};
    } else {
      const Vec3 a = semi_axes(shape);
      x = {a[0] * std::cos(p) * std::sin(q), a[1] * std::sin(p) * std::sin(q), a[2] * std::cos(q)};
    }
    points.push_back(placed(shape, x));
  }
  return points;
}

std::vector<Shape> samples() {
  return {sphere(0.6),
          oblate(0.7, 0.6),
          prolate(0.7, 0.6),
          ellipsoid({0.3, 0.7, 0.45}),
          torus(0.5, 0.2),
          moved(sphere(0.5)),
          moved(oblate(0.7, 0.6)),
          moved(prolate(0.6, 0.7)),
          moved(ellipsoid({0.3, 0.6, 0.45})),
          moved(torus(0.4, 0.15))};
}

double derivative(const Shape& shape, Vec3 point, int axis) {
  const double step = 1e-4;
  const auto at = [&](double d) {
    Vec3 x = point;
    x[axis] += d;
    return shape_function(shape, x);
  };
  return (8 * (at(step) - at(-step)) - (at(2 * step) - at(-2 * step))) / (12 * step);
}

/// Area of an ellipsoid by the trapezoidal rule in longitude and a fine Simpson rule in the height.
double area_by_quadrature(const Vec3& a) {
  const int longitudes = 400, heights = 4000;
  double sum = 0;
  for (int i = 0; i <= heights; ++i) {
    const double w = (i == 0 || i == heights) ? 1 : (i % 2 ? 4 : 2);
    const double t = -1 + 2.0 * i / heights, s = std::sqrt(1 - t * t);
    for (int j = 0; j < longitudes; ++j) {
      const double p = 2 * pi * (j + 0.5) / longitudes;
      sum += w * std::hypot(a[1] * a[2] * s * std::cos(p), a[0] * a[2] * s * std::sin(p),
                            a[0] * a[1] * t);
    }
  }
  return sum * (2.0 / heights / 3) * (2 * pi / longitudes);
}

TEST(Shapes, AxesFollowFromTheReducedVolume) {
  EXPECT_NEAR(semi_axes(oblate(0.7, 0.6))[2], 0.18077407760797001, 1e-14); // in 113-bit arithmetic
  EXPECT_NEAR(semi_axes(prolate(0.7, 0.6))[0], 0.12742324162143318, 1e-14);
  for (const double v : {0.02, 0.3, 0.6, 0.95, 0.9999, 1 - 1e-12})
    for (const Shape& shape : {oblate(0.8, v), prolate(0.8, v)}) {
      const double radius = std::sqrt(exact_area(shape) / (4 * pi));
      EXPECT_NEAR(exact_volume(shape) / (4 * pi / 3 * std::pow(radius, 3)), v, 2e-14) << v;
    }
}

TEST(Shapes, AreasAgreeWithClosedForms) {
  EXPECT_NEAR(exact_area(sphere(0.6)), 4 * pi * 0.36, 1e-14);
  const double c = semi_axes(oblate(0.7, 0.6))[2] / 0.7, e = std::sqrt(1 - c * c);
  EXPECT_NEAR(exact_area(oblate(0.7, 0.6)), 2 * pi * 0.49 * (1 + c * c / e * std::atanh(e)), 1e-13);
  const double b = semi_axes(prolate(0.7, 0.6))[0] / 0.7, f = std::sqrt(1 - b * b);
  EXPECT_NEAR(exact_area(prolate(0.7, 0.6)), 2 * pi * 0.49 * (b * b + b / f * std::asin(f)), 1e-13);
  EXPECT_NEAR(exact_area(torus(0.5, 0.2)), 0.4 * pi * pi, 1e-14);
  EXPECT_NEAR(exact_volume(torus(0.5, 0.2)), 0.04 * pi * pi, 1e-14);
}

TEST(Shapes, AreaOfAnEllipsoidAgreesWithQuadrature) {
  for (const Vec3 axes : {Vec3{0.7, 0.6, 0.5}, Vec3{0.5, 0.7, 0.6}, Vec3{0.9, 0.5, 0.7}}) {
    const double area = exact_area(ellipsoid(axes));
    EXPECT_NEAR(area, area_by_quadrature(axes), 1e-11);
  }
  EXPECT_NEAR(exact_area(ellipsoid({0.4, 0.4, 0.4})), 0.64 * pi, 1e-14);
}

TEST(Shapes, BoundingBoxIsTight) {
  for (const Shape& shape : samples()) {
    const Bounds box = bounding_box(shape);
    Vec3 low = shape.center, high = shape.center;
    for (const Vec3& x : surface_points(shape, 2000))
      for (int i = 0; i < 3; ++i)
        low[i] = std::min(low[i], x[i]), high[i] = std::max(high[i], x[i]);
    for (int i = 0; i < 3; ++i) {
      EXPECT_LE(box.low[i], low[i] + 1e-12);
      EXPECT_GE(box.high[i], high[i] - 1e-12);
      EXPECT_NEAR(box.low[i], low[i], 5e-3);
      EXPECT_NEAR(box.high[i], high[i], 5e-3);
    }
  }
}

TEST(Shapes, KnowTheirThinnestAndSharpestPlaces) {
  EXPECT_DOUBLE_EQ(smallest_half_thickness(torus(0.5, 0.2)), 0.2);
  EXPECT_DOUBLE_EQ(smallest_half_thickness(torus(0.5, 0.4)), 0.5 - 0.4); // the hole
  EXPECT_DOUBLE_EQ(smallest_radius_of_curvature(sphere(0.6)), 0.6);
  EXPECT_DOUBLE_EQ(smallest_half_thickness(ellipsoid({0.7, 0.2, 0.5})), 0.2);
  EXPECT_DOUBLE_EQ(smallest_radius_of_curvature(ellipsoid({0.7, 0.2, 0.5})), 0.04 / 0.7);
}

TEST(StartLevelSet, VanishesWithSlopeAroundOneOnTheSurface) {
  for (const Shape& shape : samples())
    for (const Vec3& x : surface_points(shape, 100)) {
      EXPECT_NEAR(shape_function(shape, x), 0, 1e-12);
      const double slope =
          std::hypot(derivative(shape, x, 0), derivative(shape, x, 1), derivative(shape, x, 2));
      EXPECT_GT(slope, 0.25);
      EXPECT_LT(slope, 4);
    }
}

TEST(StartLevelSet, IsNegativeInsideAndPositiveOutside) {
  for (const Shape& shape : samples()) {
    const double step = 0.5 * smallest_radius_of_curvature(shape);
    for (const Vec3& x : surface_points(shape, 100)) {
      const Vec3 n{derivative(shape, x, 0), derivative(shape, x, 1), derivative(shape, x, 2)};
      EXPECT_LT(shape_function(shape, {x[0] - step * n[0], x[1] - step * n[1], x[2] - step * n[2]}),
                0);
      EXPECT_GT(shape_function(shape, {x[0] + step * n[0], x[1] + step * n[1], x[2] + step * n[2]}),
                0);
    }
  }
  EXPECT_DOUBLE_EQ(shape_function(sphere(0.6), {0, 0, 0}), -0.3);
  EXPECT_GT(shape_function(torus(0.5, 0.2), {0, 0, 0}), 0);
  EXPECT_LT(shape_function(torus(0.5, 0.2), {0.5, 0, 0}), 0);
}

TEST(StartLevelSet, OfASphereIsTheDistanceNearTheSurfaceAndLevelsOff) {
  const Grid grid = Grid::cube(64, 1);
  const Shape shape = sphere(0.6);
  const auto phi = initial_phi(shape, grid);
  for (std::size_t n = 0; n < phi.size(); ++n) {
    const auto [x, y, z] = grid.position(n);
    const double distance = std::hypot(x, y, z) - 0.6;
    if (std::abs(distance) < grid.spacing) {
      EXPECT_NEAR(phi[n], distance, distance * distance);
    }
    EXPECT_LT(std::abs(phi[n]), 0.6);
  }
}

TEST(StartLevelSet, OfAnUnturnedShapeIsMirrorSymmetricToTheLastBit) {
  const Grid grid{{24, 32, 40}, 1.0 / 16};
  Shape turned = oblate(0.5, 0.6);
  turned.rotation_axis = {3, 0, 0};
  turned.rotation_angle = 90;
  for (const Shape& shape : {oblate(0.5, 0.6), torus(0.4, 0.15), turned}) {
    const auto phi = initial_phi(shape, grid);
    for (int k = 0; k < grid.nz(); ++k)
      for (int j = 0; j < grid.ny(); ++j)
        for (int i = 0; i < grid.nx(); ++i) {
          const double here = phi[grid.index(i, j, k)];
          ASSERT_EQ(here, phi[grid.index(grid.nx() - 1 - i, j, k)]);
          ASSERT_EQ(here, phi[grid.index(i, grid.ny() - 1 - j, k)]);
          ASSERT_EQ(here, phi[grid.index(i, j, grid.nz() - 1 - k)]);
        }
  }
}

TEST(StartLevelSet, OfAShiftedShapeIsTheShiftedLevelSet) {
  const Grid grid = Grid::cube(32, 1);
  Shape shape = torus(0.35, 0.15);
  const auto centred = initial_phi(shape, grid);
  shape.center = {3 * grid.spacing, -2 * grid.spacing, grid.spacing};
  const auto shifted = initial_phi(shape, grid);
  const auto wrap = [](int i) { return (i + 32) % 32; };
  for (int k = 0; k < 32; ++k)
    for (int j = 0; j < 32; ++j)
      for (int i = 0; i < 32; ++i)
        ASSERT_NEAR(shifted[grid.index(wrap(i + 3), wrap(j - 2), wrap(k + 1))],
                    centred[grid.index(i, j, k)], 1e-14);
}

/// Largest difference of neighbours: across the sides of the box, and anywhere.
std::pair<double, double> largest_differences(const Grid& grid, const std::vector<double>& phi) {
  double across = 0, anywhere = 0;
  for (std::size_t n = 0; n < phi.size(); n++)
    for (int d = 0; d < 3; d++) {
      std::array<int, 3> at{int(n % grid.nx()), int(n / grid.nx() % grid.ny()),
                            int(n / grid.nx() / grid.ny())};
      const bool at_side = at[d] + 1 == grid.nodes[d];
      at[d] = (at[d] + 1) % grid.nodes[d];
      const double difference = std::abs(phi[grid.index(at[0], at[1], at[2])] - phi[n]);
      anywhere = std::max(anywhere, difference);
      if (at_side) across = std::max(across, difference);
    }
  return {across, anywhere};
}

TEST(StartLevelSet, OfATurnedShapeIsSmoothAcrossTheSides) {
  const Grid grid = Grid::cube(32, 1);
  Shape shape = oblate(0.74, 0.74);
  shape.rotation_axis = {1, -1, 1};
  for (const double angle : {0., 20., 45., 90., -157.}) {
    shape.rotation_angle = angle;
    const auto [across, anywhere] = largest_differences(grid, initial_phi(shape, grid));
    EXPECT_LT(across, 0.8 * anywhere) << angle; // a jump would be five times as much as elsewhere
    EXPECT_LT(anywhere, 3 * grid.spacing) << angle;
  }
}

TEST(StartLevelSet, TurnsRightHandedAboutTheAxis) {
  Shape shape = ellipsoid({0.7, 0.3, 0.3});
  shape.rotation_axis = {0, 0, 2};
  shape.rotation_angle = 45;
  EXPECT_LT(shape_function(shape, {0.45, 0.45, 0}), 0);
  EXPECT_GT(shape_function(shape, {0.45, -0.45, 0}), 0);
}

/// How far outward along the normal, or inward if negative, a perturbed surface lies from a point
/// of the shape.
double normal_distance(const Shape& shape, const Vec3& x, const Perturbation& perturbation) {
  const Vec3 slope{derivative(shape, x, 0), derivative(shape, x, 1), derivative(shape, x, 2)};
  const double length = std::hypot(slope[0], slope[1], slope[2]);
  const auto value = [&](double d) {
    Vec3 y = x;
    for (int i = 0; i < 3; ++i) y[i] += d * slope[i] / length;
    return shape_function(shape, y, perturbation);
  };
  double low = -2 * perturbation.amplitude, high = -low;
  EXPECT_LT(value(low), 0);
  EXPECT_GT(value(high), 0);
  for (int n = 0; n < 24; ++n) {
    const double middle = (low + high) / 2;
    (value(middle) < 0 ? low : high) = middle;
  }
  return low;
}

std::vector<double> normal_distances(const Shape& shape, const Perturbation& perturbation) {
  std::vector<double> distances;
  for (const Vec3& x : surface_points(shape, 100))
    distances.push_back(normal_distance(shape, x, perturbation));
  return distances;
}

TEST(Perturbations, MoveTheSurfaceByAtMostTheirAmplitude) {
  for (const Shape& shape : samples()) {
    const double amplitude = 0.004;
    const auto distances = normal_distances(shape, {.amplitude = amplitude, .seed = 3});
    double sum_of_squares = 0;
    for (const double d : distances) {
      EXPECT_LT(std::abs(d), amplitude);
      sum_of_squares += d * d;
    }
    const double rms = std::sqrt(sum_of_squares / distances.size());
    EXPECT_GT(rms, 0.25 * amplitude);
    EXPECT_LT(rms, 0.55 * amplitude);
  }
}

TEST(Perturbations, AreReproducibleAndDifferForAnotherSeed) {
  const Shape shape = oblate(0.7, 0.6);
  const auto first = normal_distances(shape, {.amplitude = 0.01, .seed = 1});
  EXPECT_EQ(first, normal_distances(shape, {.amplitude = 0.01, .seed = 1}));
  const auto second = normal_distances(shape, {.amplitude = 0.01, .seed = 2});
  double product = 0, square = 0;
  for (std::size_t n = 0; n < first.size(); ++n)
    product += first[n] * second[n], square += first[n] * first[n];
  EXPECT_LT(std::abs(product / square), 0.5);
}

// Recorded once. With another compiler or library the last bits may differ, no more.
TEST(Perturbations, AreTheSameOnEveryMachine) {
  const Perturbation waves{.amplitude = 0.01, .seed = 1};
  const Perturbation arms{.amplitude = 0.01, .seed = 1, .fold = 3};
  const Vec3 x{0.3, -0.2, 0.1};
  EXPECT_NEAR(shape_function(sphere(0.6), x, waves), -0.18038141382039, 1e-13);
  EXPECT_NEAR(shape_function(sphere(0.6), x, arms), -0.18410322906678, 1e-13);
}

TEST(Perturbations, AreTheSameOnEveryGridAndWhereverTheShapeIs) {
  const Perturbation perturbation{.amplitude = 0.01, .seed = 1};
  const Shape shape = oblate(0.7, 0.6);
  for (const int nodes : {32, 72}) {
    const Grid grid = Grid::cube(nodes, 1);
    const double width = std::max(16 * grid.spacing, 0.5);
    const auto phi = initial_phi(shape, grid, perturbation);
    for (std::size_t n = 0; n < phi.size(); n += 97) {
      const Vec3 x = grid.position(n);
      const double f = shape_function(shape, x, perturbation);
      if (std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])}) > 0.5 ||
          std::abs(f) > 3 * grid.spacing)
        continue; // it feels the shape's images, or fades
      ASSERT_NEAR(phi[n], width * std::tanh(f / width), 1e-14);
    }
  }
  const auto in_place = normal_distances(shape, perturbation);
  const auto elsewhere = normal_distances(moved(shape), perturbation);
  for (std::size_t n = 0; n < in_place.size(); ++n) EXPECT_NEAR(in_place[n], elsewhere[n], 1e-8);
}

/// Amplitudes of cos(m theta + phase) around the rim of a shape, for m = 0 .. 12.
std::vector<double> modes_of_the_rim(const Shape& shape, const Perturbation& perturbation) {
  const int points = 120; // a multiple of every fold: what is beyond their reach adds to multiples
  std::vector<double> cosines(13), sines(13), modes;
  for (int n = 0; n < points; ++n) {
    const double theta = 2 * pi * n / points, radius = largest_radius(shape);
    const Vec3 x{radius * std::cos(theta), radius * std::sin(theta), 0};
    const double distance = normal_distance(shape, x, perturbation);
    for (int m = 0; m <= 12; ++m) {
      cosines[m] += 2 * distance * std::cos(m * theta) / points;
      sines[m] += 2 * distance * std::sin(m * theta) / points;
    }
  }
  for (int m = 0; m <= 12; ++m) modes.push_back(std::hypot(cosines[m], sines[m]));
  return modes;
}

TEST(Perturbations, WithAFoldHaveItsSymmetry) {
  for (const int fold : {2, 3, 4, 5, 6}) {
    const Perturbation perturbation{.amplitude = 0.004, .seed = 2, .fold = fold};
    const auto modes = modes_of_the_rim(oblate(0.7, 0.6), perturbation);
    EXPECT_NEAR(modes[fold], 0.75 * 0.004, 0.05 * 0.004);
    for (int m = 1; m <= 12; ++m) {
      if (m % fold != 0) {
        EXPECT_LT(modes[m], 1e-8) << fold << ' ' << m;
      }
    }
  }
}

TEST(Perturbations, WithAFoldTurnWithTheSeed) {
  const Shape shape = oblate(0.7, 0.6);
  const Vec3 x{0.7, 0, 0};
  const double first = normal_distance(shape, x, {.amplitude = 0.01, .seed = 1, .fold = 4});
  const double second = normal_distance(shape, x, {.amplitude = 0.01, .seed = 2, .fold = 4});
  EXPECT_GT(std::abs(first - second), 1e-4);
}

TEST(StoredFrames, HaveNoAnalyticShape) {
  const Shape frame{.kind = ShapeKind::frame, .file = "run"};
  EXPECT_THROW(initial_phi(frame, Grid::cube(16, 1)), std::logic_error);
  EXPECT_THROW(exact_area(frame), std::logic_error);
  EXPECT_THROW(exact_volume(frame), std::logic_error);
}

} // namespace
} // namespace lamella
