#pragma once
#include "scene/scene.h"

#include <vector>

namespace lamella {

/// A domain of the start shape: what of the membrane is seen from the centre of the shape within an
/// angle from a direction.
struct Cap {
  Vec3 direction;    ///< in the box, of length 1
  double half_angle; ///< radians
};

/// The Ld domains of a scene; none where they come from a frame. A cap of a given fraction of the
/// area has it to rounding on a sphere, to 1e-7 on a disc of reduced volume 0.6. Not for a torus,
/// nor for the other functions here.
std::vector<Cap> caps_of(const Scene& scene);

/// Radians.
double angle_between(const Vec3& a, const Vec3& b);

/// Area of a cap of an analytic shape; as accurate.
double area_of(const Cap& cap, const Shape& shape);

/// Where a cap of an analytic shape ends.
struct Rim {
  double radius;          ///< least distance from the axis of the cap
  double length_an_angle; ///< on the membrane across the rim, per radian seen from the centre; mean
};
Rim rim_of(const Cap& cap, const Shape& shape);

/// Area of the domains of an analytic shape, all of them flush with it; 0 without domains.
double exact_area_ld(const Scene& scene);

/// The start psi at the nodes, negative in Ld, x fastest: of the nearest cap the angle from its
/// rim, times the length on the membrane that an angle has there. So |grad_s psi| is 1 at the rim
/// (in the mean, where the shape is no body of revolution about the cap's axis), and on a sphere
/// psi is the signed distance from the phase boundary along the membrane. Constant along rays from
/// the shape's centre but for a smooth passage half way to the shape's images beyond the sides of
/// the box; kinks opposite and in the middle of a cap, and halfway between two.
std::vector<double> initial_psi(const Scene& scene);

} // namespace lamella
