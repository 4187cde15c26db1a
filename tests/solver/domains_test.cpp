#include "dynamics/start.h"
#include "error.h"
#include "geometry/phase_boundary.h"
#include "scene/builtin.h"
#include "scene/domains.h"
#include "scene/scene_toml.h"
#include "start_surface.h"
#include "store/frame.h"

#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

namespace lamella {
namespace {

using std::numbers::pi;
using testing::HasSubstr;

constexpr double degree = pi / 180;

Scene with_cap(Shape shape, double area_fraction, Vec3 direction = {0, 0, 1}) {
  Scene scene;
  scene.shape = shape;
  scene.domains = {
      .kind = DomainsKind::cap, .area_fraction = area_fraction, .direction = direction};
  return scene;
}

Scene with_caps(Shape shape, std::vector<Vec3> directions, double half_angle) {
  Scene scene;
  scene.shape = shape;
  scene.domains = {
      .kind = DomainsKind::caps, .directions = std::move(directions), .half_angle = half_angle};
  return scene;
}

const Shape ball{.kind = ShapeKind::sphere, .radius = 0.6};
const Shape disc{.kind = ShapeKind::oblate, .semi_axis = 0.7, .reduced_volume = 0.6};
const Shape rod{.kind = ShapeKind::prolate, .semi_axis = 0.8, .reduced_volume = 0.7};
const Shape pebble{.kind = ShapeKind::ellipsoid, .semi_axes = {0.7, 0.6, 0.45}};

/// Area of a spheroid beyond the plane z = c cos(t) on its axis; semi-axes a, a, c.
double polar_area(double a, double c, double t) {
  const int steps = 2000;
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double s = t * i / steps;
    const double f = a * std::sin(s) * std::hypot(a * std::cos(s), c * std::sin(s));
    sum += (i == 0 || i == steps ? 1 : i % 2 ? 4 : 2) * f;
  }
  return 2 * pi * sum * t / steps / 3;
}

TEST(Domains, OfASphereHaveTheAreaOfCaps) {
  const Cap cap = caps_of(with_cap(ball, 0.2)).at(0);
  EXPECT_DOUBLE_EQ(cap.half_angle, std::acos(0.6));
  EXPECT_NEAR(area_of(cap, ball), 0.2 * exact_area(ball), 1e-15);
  EXPECT_NEAR(exact_area_ld(with_caps(ball, {{1, 0, 0}, {0, 2, 0}, {-1, -1, 0}}, 20)),
              3 * 2 * pi * 0.36 * (1 - std::cos(20 * degree)), 1e-14);
}

TEST(Domains, HaveTheirFractionOfASpheroid) {
  for (const Shape& shape : {disc, rod}) {
    const Vec3 axes = semi_axes(shape);
    for (const double fraction : {0.05, 0.3, 0.5, 0.9}) {
      const double seen = caps_of(with_cap(shape, fraction)).at(0).half_angle;
      const double t = std::atan2(axes[2] * std::sin(seen), axes[0] * std::cos(seen));
      EXPECT_NEAR(polar_area(axes[0], axes[2], t) / exact_area(shape), fraction, 1e-7);
    }
  }
}

TEST(Domains, HaveTheirFractionInAnyDirection) {
  for (const Shape& shape : {disc, rod, pebble}) {
    const Vec3 direction{0.3, -0.5, 0.4}, opposite{-0.3, 0.5, -0.4};
    const Cap half = caps_of(with_cap(shape, 0.5, direction)).at(0);
    EXPECT_NEAR(half.half_angle, pi / 2, 1e-7);
    const Cap cap = caps_of(with_cap(shape, 0.2, direction)).at(0);
    const Cap rest = caps_of(with_cap(shape, 0.8, opposite)).at(0);
    EXPECT_NEAR(cap.half_angle + rest.half_angle, pi, 1e-6);
  }
}

TEST(Domains, TurnWithTheirDirectionNotWithTheShape) {
  Shape turned = disc;
  turned.rotation_axis = {0, 1, 0};
  turned.rotation_angle = 90; // its axis becomes x
  const Cap upright = caps_of(with_cap(disc, 0.1, {0, 0, 1})).at(0);
  EXPECT_NEAR(caps_of(with_cap(turned, 0.1, {1, 0, 0})).at(0).half_angle, upright.half_angle,
              1e-10);
  EXPECT_LT(caps_of(with_cap(turned, 0.1, {0, 0, 1})).at(0).half_angle, upright.half_angle / 2);
}

TEST(StartPhases, AreTheDistanceFromTheRimOnASphere) {
  Scene scene = with_cap(ball, 0.3, {1, 2, 2});
  scene.shape.center = {0.1, -0.05, 0.2};
  const double half_angle = std::acos(1 - 2 * 0.3);
  const auto psi = initial_psi(scene);
  const Grid grid = scene.grid();
  ASSERT_EQ(psi.size(), grid.size());
  for (std::size_t n = 0; n < psi.size(); n += 7) {
    Vec3 d = grid.position(n);
    for (int i = 0; i < 3; ++i) d[i] = std::remainder(d[i] - scene.shape.center[i], 2);
    if (std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])}) > 0.5) continue; // of an image
    const double cosine = (d[0] + 2 * d[1] + 2 * d[2]) / 3 / std::hypot(d[0], d[1], d[2]);
    ASSERT_NEAR(psi[n], 0.6 * (std::acos(cosine) - half_angle), 1e-7);
  }
}

TEST(StartPhases, AreNegativeInEveryCapAndNowhereElse) {
  const std::vector<Vec3> directions{{1, 0, 0}, {0, -1, 0}, {1, 1, 1}};
  const Scene scene = with_caps(ball, directions, 25);
  const auto psi = initial_psi(scene);
  for (std::size_t n = 0; n < psi.size(); n += 11) {
    const auto [x, y, z] = scene.grid().position(n);
    const double r = std::hypot(x, y, z);
    if (r > ball.radius + 2 * scene.grid().spacing) continue; // of an image
    const double largest_cosine = std::max({x, -y, (x + y + z) / std::sqrt(3.0)}) / r;
    ASSERT_EQ(psi[n]<0, largest_cosine> std::cos(25 * degree));
  }
}

/// |grad_s psi| at the rim in the plane of x and z, by the distance along the surface between two
/// angles from the z axis.
double slope_at_the_rim(const Shape& shape, const Cap& cap, const Rim& rim) {
  const Vec3 axes = semi_axes(shape);
  const auto at = [&](double angle) {
    const double r = 1 / std::hypot(std::sin(angle) / axes[0], std::cos(angle) / axes[2]);
    return std::pair{r * std::sin(angle), r * std::cos(angle)};
  };
  const auto [x0, z0] = at(cap.half_angle - 1e-4);
  const auto [x1, z1] = at(cap.half_angle + 1e-4);
  return rim.length_an_angle * 2e-4 / std::hypot(x1 - x0, z1 - z0);
}

TEST(StartPhases, HaveSlopeOneAtTheRim) {
  for (const Shape& shape : {ball, disc, rod}) {
    const Cap cap = caps_of(with_cap(shape, 0.25)).at(0);
    EXPECT_NEAR(slope_at_the_rim(shape, cap, rim_of(cap, shape)), 1, 1e-6);
  }
  const Cap cap = caps_of(with_cap(pebble, 0.25)).at(0);
  EXPECT_NEAR(slope_at_the_rim(pebble, cap, rim_of(cap, pebble)), 1, 0.1);
  EXPECT_NEAR(rim_of({{0, 0, 1}, 30 * degree}, ball).radius, 0.3, 1e-15);
}

const Shape globe{.kind = ShapeKind::sphere, .radius = 1};
const std::vector<Vec3> two_sides{{1, 2, 2}, {0, 1, -1}};

/// On the grid of fig15b.
Scene with_bulges(double half_angle, double bulge) {
  Scene scene = with_caps(globe, two_sides, half_angle);
  scene.nodes = {80, 80, 80};
  scene.half_width = 1.5;
  scene.domains.bulge = bulge;
  return scene;
}

/// A spherical cap over the plane of its rim.
struct CapOnRim {
  CapOnRim(double rim_radius, double angle) : height(rim_radius * std::tan(angle / 2)) {
    const double square = rim_radius * rim_radius;
    area = pi * (square + height * height);
    volume = pi * height * (3 * square + height * height) / 6;
  }
  double height, area, volume;
};

// Against caps with a sharp rim; rounding it takes a few thousandths away.
TEST(Bulges, MakeTheAreaAndVolumeOfCapsOverTheSameRim) {
  for (const auto& [half_angle, bulge] :
       {std::pair{8.6, -45.0}, {20.0, -45.0}, {20.0, 5.0}, {20.0, 60.0}, {60.0, 30.0}}) {
    const Scene scene = with_bulges(half_angle, bulge);
    const StartSurface surface(start_of(scene).phi, scene.grid());
    const SurfaceGeometry& g = surface.geometry;
    double area = 0, volume = 0, curvature = 0, largest_curvature = 0;
    for (std::size_t i = 0; i < g.size(); ++i) {
      const Vec3 x = g.point(i), n = g.normal(i);
      area += g.weight()[i];
      volume += g.weight()[i] * (x[0] * n[0] + x[1] * n[1] + x[2] * n[2]) / 3;
      curvature += g.weight()[i] * g.K()[i];
      largest_curvature = std::max(largest_curvature, std::abs(g.KM()[i]));
      EXPECT_NEAR(g.grad()[i], 1, 0.25);
    }
    const double rim = std::sin(half_angle * degree);
    const CapOnRim before(rim, half_angle * degree), after(rim, bulge * degree);
    EXPECT_NEAR(area / (4 * pi + 2 * (after.area - before.area)), 1, 4e-3) << half_angle;
    EXPECT_NEAR(volume / (4 * pi / 3 + 2 * (after.volume - before.volume)), 1, 1e-2) << half_angle;
    EXPECT_NEAR(curvature / (4 * pi), 1, 4e-3) << half_angle;
    EXPECT_LT(largest_curvature * scene.grid().spacing, 0.75) << half_angle;
  }
}

TEST(Bulges, ReachToTheHeightOfTheirCap) {
  const double rim = std::sin(20 * degree), to_rim = std::cos(20 * degree);
  for (const double bulge : {-70.0, -10.0, 10.0, 50.0, 90.0}) {
    const BulgedCap cap(1, {{0, 0, 1}, 20 * degree}, bulge * degree, 0.05);
    const double top = to_rim + CapOnRim(rim, bulge * degree).height;
    const auto phi = [&](double z) { return cap((z * z - 1) / 2, {0, 0, z}); };
    EXPECT_NEAR(phi(top), 0, 1e-12);
    EXPECT_NEAR((phi(top + 1e-4) - phi(top - 1e-4)) / 2e-4, 1, 1e-3);
    EXPECT_NEAR(phi(-1.1), 0.105, 1e-12);
    EXPECT_NEAR(bulge_height(with_bulges(20, bulge)), std::max(0.0, top - 1), 1e-12);
  }
}

TEST(Bulges, AreWhereThePhasesAre) {
  Scene scene = with_bulges(20, -45);
  scene.shape.center = {0.1, -0.05, 0.2};
  scene.shape.rotation_axis = {1, 0, 2};
  scene.shape.rotation_angle = 70;
  const Start start = start_of(scene);
  EXPECT_FALSE(start.exact);
  const auto without = initial_phi(scene.shape, scene.grid());
  scene.domains.bulge = 0;
  const auto psi = initial_psi(scene);
  const double h = scene.grid().spacing;
  for (std::size_t n = 0; n < without.size(); ++n) {
    if (std::abs(without[n]) > h) continue;
    ASSERT_NEAR(start.fields.at("psi")[n], psi[n], 0.1 * h); // images count by their level sets
    const double change = start.phi[n] - without[n];
    ASSERT_GT(change, -1e-14);
    if (start.fields.at("psi")[n] > 3 * h) {
      ASSERT_LT(change, 1e-14);
    }
    if (start.fields.at("psi")[n] < -3 * h) {
      ASSERT_GT(change, h);
    }
  }
}

TEST(Bulges, OfTheHalfAngleAreFlush) {
  const Scene flush = with_bulges(20, 20);
  EXPECT_EQ(start_of(flush).phi, initial_phi(globe, flush.grid()));
  EXPECT_TRUE(start_of(flush).exact);
}

/// The boundary of the domains a scene starts with, as the solver finds it.
PhaseBoundary boundary_of(const Scene& scene) {
  const Start start = start_of(scene);
  StartSurface surface(start.phi, scene.grid());
  const double width = 6 * scene.grid().spacing;
  std::vector<double> nodal = start.fields.at("psi");
  for (double& psi : nodal) psi = width * std::tanh(psi / width);
  LevelSet psi(scene.grid());
  std::ranges::copy(nodal, psi.coefficients().begin());
  psi.fit(nodal, surface.fourier);
  PhaseBoundary boundary;
  boundary.trace(surface.phi, psi, surface.band);
  return boundary;
}

// That of dimples is at their rounded rim, a quarter of a spacing further in.
TEST(Starts, HaveTheBoundaryOfEveryDomain) {
  for (const auto& [name, count, tolerance] : {std::tuple{"fig9", 1u, 1e-4},
                                               {"fig13a", 12u, 1e-4},
                                               {"fig15a", 14u, 1e-4},
                                               {"fig15b", 14u, 0.015}}) {
    const Scene scene = builtin_scene(name);
    const PhaseBoundary boundary = boundary_of(scene);
    EXPECT_EQ(boundary.curves(), count) << name;
    EXPECT_EQ(boundary.unresolved().size(), 0u) << name;
    const double exact = count * 2 * pi * 0.98 * std::sin(caps_of(scene)[0].half_angle);
    EXPECT_NEAR(boundary.length() / exact, 1, tolerance) << name;
  }
}

TEST(Starts, HaveWhatTheSceneHas) {
  Scene scene = with_cap(ball, 0.2);
  scene.nodes = {32, 32, 32};
  const Start two = start_of(scene);
  EXPECT_EQ(two.fields.at("psi"), initial_psi(scene));
  EXPECT_TRUE(!two.fields.contains("c"));
  EXPECT_NEAR(two.exact->area_ld, 0.2 * two.exact->area, 1e-14);
  scene.domains = {};
  const Start one = start_of(scene);
  EXPECT_EQ(one.phi, two.phi);
  EXPECT_TRUE(!one.fields.contains("psi"));
  EXPECT_EQ(one.exact->area_ld, 0);
}

/// A scene of kind frame and two stored states for it.
class StartsFromFrames : public testing::Test {
protected:
  StartsFromFrames() {
    std::filesystem::create_directories(folder_);
    stored_.nodes = {16, 16, 16};
    const Start start = start_of(stored_);
    Frame frame{.grid = stored_.grid(),
                .phi = start.phi,
                .cells = {1, 0, 2},
                .fields = {{"psi", start.fields.at("psi")},
                           {"c", std::vector<double>(start.phi.size(), 1.01)}}};
    write_frame(two_phases_, frame);
    frame.cells = {1, 3, 2};
    frame.fields.erase("psi");
    frame.fields.erase("c");
    write_frame(one_phase_, frame);
    scene_.nodes = stored_.nodes;
    scene_.shape.kind = ShapeKind::frame;
    scene_.shape.file = two_phases_;
    scene_.domains.kind = DomainsKind::frame;
  }
  ~StartsFromFrames() override { std::filesystem::remove_all(folder_); }

  std::string message() const {
    try {
      start_of(scene_);
    } catch (const RunError& error) {
      return error.what();
    }
    return "no RunError";
  }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() /
      ("lamella domains test " + std::to_string(::getpid())); // tests run side by side
  const std::string two_phases_ = folder_ / "two.hdf", one_phase_ = folder_ / "one.hdf";
  Scene stored_ = with_cap(ball, 0.4);
  Scene scene_;
};

TEST_F(StartsFromFrames, TakeWhatTheSceneHas) {
  scene_.stretch.modulus = 1000;
  const Start start = start_of(scene_);
  EXPECT_EQ(start.phi, initial_phi(ball, stored_.grid()));
  EXPECT_EQ(start.fields.at("psi"), initial_psi(stored_));
  EXPECT_EQ(start.fields.at("c").at(7), 1.01);
  EXPECT_FALSE(start.exact);
  scene_.domains.kind = DomainsKind::none;
  scene_.stretch.modulus = 0;
  EXPECT_TRUE(!start_of(scene_).fields.contains("psi"));
  EXPECT_TRUE(!start_of(scene_).fields.contains("c"));
}

TEST_F(StartsFromFrames, TakePhasesOfAnotherFrameToWhereTheyWere) {
  scene_.shape.file = one_phase_; // its box has moved by 3 spacings more along y
  scene_.domains.file = two_phases_;
  const Start start = start_of(scene_);
  const std::vector<double> there = initial_psi(stored_);
  const Grid grid = scene_.grid();
  EXPECT_EQ(start.fields.at("psi")[grid.index(4, 5, 6)], there[grid.index(4, 8, 6)]);
  EXPECT_EQ(start.cells, (std::array{1, 3, 2}));
}

TEST_F(StartsFromFrames, NeedPhasesThereAndTheSameGrid) {
  scene_.shape.file = one_phase_;
  EXPECT_THAT(message(), HasSubstr("one.hdf has one phase; domains.kind must be \"none\""));
  scene_.domains.file = two_phases_;
  EXPECT_EQ(message(), "no RunError");
  scene_.half_width = 2;
  EXPECT_THAT(message(), HasSubstr("must be those of the frame"));
}

} // namespace
} // namespace lamella
