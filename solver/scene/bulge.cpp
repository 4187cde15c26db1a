#include "scene/bulge.h"

#include "scene/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lamella {
namespace {

/// Half width of the rounded rim, in grid spacings.
constexpr double rim_rounding = 2;

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// |x|, rounded where it is below w.
double rounded_abs(double x, double w) {
  const double q = x / w * (x / w);
  if (q >= 1) return std::abs(x);
  return w / 128 * (35 + q * (140 - q * (70 - q * (28 - q * 5))));
}

} // namespace

BulgedCap::BulgedCap(double sphere_radius, const Cap& cap, double bulge, double rounding)
    : radius_(sphere_radius * std::sin(cap.half_angle) / std::sin(bulge)),
      side_(bulge < cap.half_angle ? 1 : -1),
      width_(2 * std::abs(std::sin((cap.half_angle - bulge) / 2)) * rounding) {
  const double height = sphere_radius * std::cos(cap.half_angle) - radius_ * std::cos(bulge);
  for (int i = 0; i < 3; ++i) center_[i] = height * cap.direction[i];
}

double BulgedCap::operator()(double phi, const Vec3& x) const {
  const double square = (Eigen::Vector3d(x[0], x[1], x[2]) - center_).squaredNorm();
  const double other = (square - radius_ * radius_) / (2 * radius_);
  return (phi + other + side_ * rounded_abs(phi - other, width_)) / 2;
}

double bulge_height(const Scene& scene) {
  if (!scene.domains.is_bulged()) return 0;
  const double half_angle = radians(scene.domains.half_angle);
  const double reach =
      std::cos(half_angle) + std::sin(half_angle) * std::tan(radians(scene.domains.bulge) / 2);
  return scene.shape.radius * std::max(0.0, reach - 1);
}

std::vector<BulgedCap> bulged_caps(const Scene& scene) {
  const double bulge = radians(scene.domains.bulge);
  std::vector<BulgedCap> caps;
  if (!scene.domains.is_bulged()) return caps;
  for (Cap cap : caps_of(scene)) {
    cap.direction = in_own_frame(scene.shape, cap.direction);
    caps.emplace_back(scene.shape.radius, cap, bulge, rim_rounding * scene.grid().spacing);
  }
  return caps;
}

} // namespace lamella
