// The sides of the box are not felt: a vesicle near them does what it does in a larger box.
#include "runs.h"
#include "scene/shapes.h"

#include <random>

namespace lamella {
namespace {

/// Numbers that are the same with every library.
class Random {
public:
  explicit Random(int seed) : bits_(std::mt19937_64::result_type(seed)) {}
  double between(double low, double high) {
    return low + (high - low) * 0x1p-53 * double(bits_() >> 11);
  }
  Vec3 vector() { return {between(-1, 1), between(-1, 1), between(-1, 1)}; }

private:
  std::mt19937_64 bits_;
};

Shape random_shape(Random& random) {
  Shape shape;
  const int kind = int(random.between(0, 3));
  shape.kind = kind == 0   ? ShapeKind::oblate
               : kind == 1 ? ShapeKind::prolate
                           : ShapeKind::ellipsoid;
  shape.semi_axis = 1;
  shape.reduced_volume = random.between(0.7, 0.95);
  shape.semi_axes = {1, random.between(0.5, 0.9), random.between(0.45, 0.9)};
  shape.rotation_axis = random.vector();
  shape.rotation_angle = random.between(-180, 180);
  return shape;
}

/// A shape anywhere in a box of any shape, 3 to 5 spacings from a side along one axis.
Scene random_scene(Random& random) {
  Scene scene;
  for (int& n : scene.nodes) n = 8 * int(random.between(3, 6));
  const double h = 2. / std::ranges::min(scene.nodes), clearance = random.between(3.01, 5) * h;
  Shape& shape = scene.shape = random_shape(random);
  const Vec3 reach = bounding_box(shape).high;
  double size = 1e300;
  for (int d = 0; d < 3; d++)
    size = std::min(size, (scene.nodes[d] * h / 2 - clearance) / reach[d]);
  shape.semi_axis *= size;
  for (double& a : shape.semi_axes) a *= size;
  for (int d = 0; d < 3; d++) {
    const double free = scene.nodes[d] * h / 2 - 3.01 * h - reach[d] * size;
    shape.center[d] = free * random.between(-1, 1);
  }
  scene.end_time = random.between(2e-3, 4e-3) * size * size * size * size;
  return scene;
}

/// With eight spacings more at every side.
Scene in_larger_box(Scene scene) {
  const double h = scene.grid().spacing;
  for (int& n : scene.nodes) n += 16;
  scene.half_width = h * std::ranges::min(scene.nodes) / 2;
  return scene;
}

std::vector<Event::Kind> kinds(std::span<const Event> events) {
  std::vector<Event::Kind> kinds;
  for (const Event& e : events)
    if (e.kind != Event::Kind::recentred) kinds.push_back(e.kind);
  return kinds;
}

void expect_same_in_a_larger_box(const Scene& scene, double tolerance, const std::string& which) {
  SCOPED_TRACE(which);
  ASSERT_NO_THROW(validate(scene));
  const Outcome here = follow(scene), there = follow(in_larger_box(scene));
  EXPECT_EQ(kinds(here.events), kinds(there.events));
  const double energy = there.history.back().energy;
  EXPECT_NEAR(here.history.back().energy / energy, 1, tolerance);
}

// Runs come near rest: on the way there, energies differ by the error of unequal steps, 2e-4.
// Measured: 4e-5 with one phase, 3.3e-4 with two. 12 pairs of runs, 20 s of one core.
TEST(Box, IsNotFelt) {
  for (int seed = 1; seed <= 6; seed++) {
    Random random(seed);
    expect_same_in_a_larger_box(random_scene(random), 1e-4, "seed " + std::to_string(seed));
  }
}

TEST(Box, IsNotFeltByTwoPhases) {
  for (int seed = 1; seed <= 3; seed++) {
    Random random(100 + seed);
    Scene scene = random_scene(random);
    scene.domains.kind = DomainsKind::cap;
    scene.domains.area_fraction = random.between(0.35, 0.6);
    scene.domains.direction = random.vector();
    scene.line.tension = random.between(5, 20);
    scene.lo.bending_modulus = random.between(1, 2);
    expect_same_in_a_larger_box(scene, 5e-4, "seed " + std::to_string(seed));
  }
}

TEST(Box, IsNotFeltByATurnedOblateThreeSpacingsFromItsSides) {
  for (const double angle : {-157., 20., 90.}) {
    Scene scene = scene_of(oblate(0.74, 0.74), 32, 1e-3);
    scene.shape.rotation_axis = {1, -1, 1};
    scene.shape.rotation_angle = angle;
    expect_same_in_a_larger_box(scene, 1e-4, std::to_string(angle) + " degrees");
  }
}

} // namespace
} // namespace lamella
