#include "extremes/random_scene.h"

#include "error.h"
#include "scene/scene_toml.h"
#include "scene/shapes.h"
#include "scene/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace lamella {

namespace {

/// Draws that are the same with every standard library.
class Dice {
public:
  Dice(std::uint64_t seed, int number) : engine_(seed * 1000003 + std::uint64_t(number)) {}

  double between(double low, double high) {
    return low + (high - low) * (double(engine_() >> 11) * 0x1p-53);
  }
  int of(int count) { return int(engine_() % std::uint64_t(count)); }
  bool chance(double share) { return between(0, 1) < share; }
  double decades(double low, double high) { return std::pow(10, between(low, high)); }
  double sign() { return chance(0.5) ? 1 : -1; }
  Vec3 direction() {
    const double z = between(-1, 1), angle = between(0, 2 * std::numbers::pi);
    const double rho = std::sqrt(1 - z * z);
    return {rho * std::cos(angle), rho * std::sin(angle), z};
  }

private:
  std::mt19937_64 engine_;
};

/// The length of the series' boxes, before units are drawn, is 2 along their shortest axis.
constexpr double largest_size = 0.9;

void draw_shape(Dice& dice, Scene& scene) {
  constexpr ShapeKind kinds[]{ShapeKind::oblate, ShapeKind::prolate, ShapeKind::ellipsoid,
                              ShapeKind::sphere, ShapeKind::torus};
  Shape& shape = scene.shape;
  shape.kind = kinds[dice.of(5)];
  const double size = dice.between(0.4, largest_size);
  shape.radius = shape.semi_axis = size;
  shape.reduced_volume = dice.between(0.6, 0.99);
  shape.semi_axes = {size, size * dice.between(0.5, 1), size * dice.between(0.5, 1)};
  shape.ring_radius = size * dice.between(0.55, 0.75);
  shape.tube_radius = size - shape.ring_radius;
  if (dice.chance(0.7)) {
    shape.rotation_axis = dice.direction();
    shape.rotation_angle = dice.chance(0.2) ? 90 * (dice.of(9) - 4) : dice.between(-360, 360);
  }
  if (dice.chance(0.3))
    scene.perturbation = {.amplitude = dice.decades(-3, -1.3),
                          .seed = dice.of(1000),
                          .fold = dice.chance(0.3) ? 2 + dice.of(4) : 0};
}

/// As near to the sides as validation lets it, or not so near.
void draw_place(Dice& dice, Scene& scene) {
  const Bounds bounds = bounding_box(scene.shape);
  const Grid grid = scene.grid();
  for (int d = 0; d < 3; d++) {
    const double clearance = dice.between(3, 6) * grid.spacing + scene.perturbation.amplitude;
    const double room = 0.5 * grid.length(d) - 0.5 * (bounds.high[d] - bounds.low[d]) - clearance;
    scene.shape.center[d] = std::max(room, 0.0) * dice.between(-1, 1);
  }
}

void draw_domains(Dice& dice, Scene& scene) {
  Domains& domains = scene.domains;
  domains.kind = dice.chance(0.5) ? DomainsKind::cap : DomainsKind::caps;
  domains.area_fraction = dice.between(0.1, 0.9);
  domains.direction = dice.direction();
  domains.directions = {dice.direction()};
  const Vec3 first = domains.directions.front();
  if (dice.chance(0.5)) domains.directions.push_back({-first[0], -first[1], -first[2]});
  domains.half_angle = dice.between(20, 70);
  if (scene.shape.kind == ShapeKind::sphere && dice.chance(0.5))
    domains.bulge = dice.between(-20, 60);
  const auto phase = [&] {
    SurfaceModuli p;
    p.bending_modulus = dice.decades(-1, 1);
    if (dice.chance(0.3)) p.spontaneous_curvature = dice.sign() * dice.decades(-1, 1);
    if (dice.chance(0.3)) p.gaussian_modulus = dice.sign() * dice.between(0, 4) * p.bending_modulus;
    return p;
  };
  scene.ld = phase();
  scene.lo = phase();
  Line& line = scene.line;
  if (dice.chance(0.8)) line.tension = dice.decades(-1, 2);
  for (double* modulus : {&line.geodesic_modulus, &line.torsion_modulus, &line.normal_modulus})
    if (dice.chance(0.15)) *modulus = dice.sign() * dice.decades(-1, 0.5);
  if (dice.chance(0.2)) scene.stretch.modulus = dice.decades(0, 3);
}

void draw_one_phase(Dice& dice, Scene& scene) {
  if (dice.chance(0.4)) scene.membrane.spontaneous_curvature = dice.sign() * dice.decades(-1, 1.2);
  if (dice.chance(0.2)) scene.area_difference.multiplier = dice.sign() * dice.decades(-1, 1.3);
}

void draw_constraints(Dice& dice, Scene& scene) {
  if (dice.chance(0.3)) {
    scene.volume.constraint = Constraint::ramped;
    scene.volume.ramp = {
        {dice.between(0.5, 1)}, {dice.between(0, scene.end_time)}, dice.decades(0, 2)};
  } else if (dice.chance(0.2)) {
    scene.volume.constraint = Constraint::free;
    scene.volume.pressure = dice.sign() * dice.decades(0, 2.5);
  }
  if (!scene.has_phases() && dice.chance(0.25)) {
    scene.area_difference.constraint = dice.chance(0.5) ? Constraint::fixed : Constraint::ramped;
    scene.area_difference.multiplier = 0;
    scene.area_difference.ramp = {
        {dice.between(0.8, 1.4)}, {dice.between(0, scene.end_time)}, dice.decades(0, 2)};
  }
  if (dice.chance(0.15))
    scene.contact = {.disjoining_pressure = dice.decades(1, 4),
                     .disjoining_range = dice.between(0.01, 0.05)};
}

/// Powers of two, so that nothing is rounded: a scene in other units must then go the same way to
/// the last bit.
UnitChange draw_units(Dice& dice) {
  return {std::exp2(dice.of(21) - 10), std::exp2(dice.of(21) - 10)};
}

Scene draw(Dice& dice) {
  Scene scene;
  for (int& n : scene.nodes) n = 32;
  scene.nodes[dice.of(3)] += 8 * dice.of(3);
  draw_shape(dice, scene);
  draw_place(dice, scene);
  scene.end_time = dice.decades(-4.5, -2.5);
  const bool phases = scene.shape.kind != ShapeKind::torus && dice.chance(0.5);
  phases ? draw_domains(dice, scene) : draw_one_phase(dice, scene);
  draw_constraints(dice, scene);
  return in_units(scene, draw_units(dice));
}

} // namespace

Scene random_scene(std::uint64_t seed, int number) {
  Dice dice(seed, number);
  for (;;) {
    Scene scene = draw(dice);
    scene.name = fmt::format("random_{}_{}", seed, number);
    try {
      validate(scene);
      return parse_scene(to_toml(scene), scene.name); // without what does not count in it
    } catch (const SceneError&) {                     // of a kind that is refused
    }
  }
}

} // namespace lamella
