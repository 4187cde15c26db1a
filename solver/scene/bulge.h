#pragma once
#include "scene/domains.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace lamella {

/// A cap of a sphere about the origin that gives way to a spherical cap of another height over the
/// same rim, as a change of the sphere's level set.
///
/// With a the level set of the sphere and b that of the new cap's sphere, both quadratic with slope
/// 1 on their surfaces, it is max(a, b), or min(a, b) for a cap that bulges more than the sphere.
/// |a - b| in these is rounded to (35 + 140 u^2 - 70 u^4 + 28 u^6 - 5 u^8) w / 128, u = (a - b) /
/// w, where |u| < 1, which makes it four times differentiable. w is such that this is up to a given
/// distance from the ridge between the two.
class BulgedCap {
public:
  /// `bulge`: angle between the membrane and the plane of the rim, radians, negative for a dimple;
  /// neither 0 nor the cap's half angle.
  BulgedCap(double sphere_radius, const Cap& cap, double bulge, double rounding);

  /// The level set at a point, given the value there without this cap.
  double operator()(double phi, const Vec3& x) const;

private:
  Eigen::Vector3d center_; ///< of the new cap's sphere
  double radius_;          ///< of the same, negative for a dimple
  double side_;            ///< 1: max(a, b), -1: min(a, b)
  double width_;           ///< w
};

/// How far the caps of a scene reach beyond its sphere; 0 where none does.
double bulge_height(const Scene& scene);

/// The caps of a scene that are not flush with its sphere, in the sphere's own frame.
std::vector<BulgedCap> bulged_caps(const Scene& scene);

} // namespace lamella
