#include "scene/domains.h"

#include "scene/bulge.h"
#include "scene/shapes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lamella {
namespace {

using Eigen::Array3d;
using Eigen::Vector3d;
using std::numbers::pi;

constexpr int azimuths = 128;
constexpr int angles = 400; // even, for Simpson's rule

Vector3d vector(const Vec3& v) { return {v[0], v[1], v[2]}; }

Vec3 normalized(const Vec3& v) {
  const Vector3d u = vector(v).stableNormalized();
  return {u[0], u[1], u[2]};
}

/// An ellipsoid as seen from its centre, in spherical coordinates about a direction.
class View {
public:
  View(const Shape& shape, const Vec3& direction)
      : axes_(vector(semi_axes(shape))), pole_(vector(in_own_frame(shape, direction))),
        east_(pole_.unitOrthogonal()), north_(pole_.cross(east_)) {}

  /// Area seen within an angle, by Simpson's rule in the angle and the trapezoidal in the azimuth.
  double area_within(double half_angle) const {
    double sum = 0;
    for (int i = 1; i <= angles; ++i) {
      const double angle = half_angle * i / angles;
      const double ring = mean_at(angle, [&](const Vector3d& u, const Vector3d&) {
        return radius(u) * radius(u) / normal(u).dot(u);
      });
      sum += (i == angles ? 1 : i % 2 ? 4 : 2) * ring * std::sin(angle);
    }
    return 2 * pi * sum * half_angle / angles / 3;
  }

  Rim rim(double angle) const {
    double least = std::numeric_limits<double>::max();
    const double scale = mean_at(angle, [&](const Vector3d& u, const Vector3d& across) {
      least = std::min(least, radius(u) * std::sin(angle));
      const double slope = across.dot(normal(u));
      return radius(u) / std::sqrt(1 - slope * slope); // 1 / |grad_s angle|
    });
    return {least, scale};
  }

private:
  double radius(const Vector3d& u) const { return 1 / (u.array() / axes_).matrix().norm(); }
  Vector3d normal(const Vector3d& u) const {
    return (u.array() / axes_.square()).matrix().normalized();
  }

  /// Mean around the pole of f(u, du / dangle), u the direction at an angle from it.
  template <class F>
  double mean_at(double angle, F&& f) const {
    double sum = 0;
    for (int j = 0; j < azimuths; ++j) {
      const double azimuth = 2 * pi * j / azimuths;
      const Vector3d away = std::cos(azimuth) * east_ + std::sin(azimuth) * north_;
      sum += f(std::cos(angle) * pole_ + std::sin(angle) * away,
               std::cos(angle) * away - std::sin(angle) * pole_);
    }
    return sum / azimuths;
  }

  Array3d axes_;
  Vector3d pole_, east_, north_;
};

/// Bisection, but for a sphere.
double half_angle_of(double area_fraction, const Vec3& direction, const Shape& shape) {
  if (shape.kind == ShapeKind::sphere) return std::acos(1 - 2 * area_fraction);
  const View view(shape, direction);
  const double target = area_fraction * exact_area(shape);
  double low = 0, high = pi;
  while (high - low > 1e-11) {
    const double middle = (low + high) / 2;
    (view.area_within(middle) < target ? low : high) = middle;
  }
  return low;
}

} // namespace

std::vector<Cap> caps_of(const Scene& scene) {
  const Domains& domains = scene.domains;
  std::vector<Cap> caps;
  if (domains.kind == DomainsKind::cap) {
    const Vec3 direction = normalized(domains.direction);
    caps.push_back({direction, half_angle_of(domains.area_fraction, direction, scene.shape)});
  }
  if (domains.kind == DomainsKind::caps)
    for (const Vec3& direction : domains.directions)
      caps.push_back({normalized(direction), domains.half_angle * pi / 180});
  return caps;
}

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(vector(a).cross(vector(b)).norm(), vector(a).dot(vector(b)));
}

double area_of(const Cap& cap, const Shape& shape) {
  if (shape.kind != ShapeKind::sphere)
    return View(shape, cap.direction).area_within(cap.half_angle);
  const double chord = 2 * shape.radius * std::sin(cap.half_angle / 2);
  return pi * chord * chord;
}

Rim rim_of(const Cap& cap, const Shape& shape) {
  return View(shape, cap.direction).rim(cap.half_angle);
}

double exact_area_ld(const Scene& scene) {
  double area = 0;
  for (const Cap& cap : caps_of(scene)) area += area_of(cap, scene.shape);
  return area;
}

std::vector<double> initial_psi(const Scene& scene) {
  const Grid grid = scene.grid();
  const std::vector<Cap> caps = caps_of(scene);
  std::vector<double> lengths;
  for (const Cap& cap : caps) lengths.push_back(rim_of(cap, scene.shape).length_an_angle);
  return mean_over_images(scene.shape, grid, bulged_caps(scene), [&](const Vec3& d) {
    double psi = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < caps.size(); ++i)
      psi = std::min(psi, lengths[i] * (angle_between(d, caps[i].direction) - caps[i].half_angle));
    return psi;
  });
}

} // namespace lamella
