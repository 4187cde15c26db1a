#pragma once
#include "scene/scene.h"

#include <vector>

namespace lamella {

/// Distance between neighbouring crests of a perturbation, at least.
double shortest_wavelength(const Perturbation& perturbation, const Shape& shape);

/// The displacement field of a perturbation, smooth in all space and the same on every grid. With a
/// the amplitude it is a u / sqrt(1 + |u|^2), thus shorter than a, where
///
/// - without a fold, u is a sum of 32 plane waves of random directions, phases and polarisations,
///   with wave numbers spread evenly from a third of the largest to the largest; |u| is 1 in the
///   mean square, so that about 0.4 a of the displacement is normal to the surface, rms;
/// - with a fold m, u = (rho / R)^(m + 1) cos(m (theta - theta_0)) away from the shape's axis. rho
///   and theta are cylindrical coordinates about it, R the largest rho of the shape; theta_0
///   follows from the seed, so that the arms do not lie along the grid.
class Displacement {
public:
  Displacement(const Perturbation& perturbation, const Shape& shape);

  /// At a point in the shape's own frame, the origin at its centre and the axis along z.
  Vec3 operator()(const Vec3& x) const;

private:
  struct Wave {
    Vec3 wave_vector, polarisation;
    double phase;
  };

  Vec3 waves(const Vec3& x) const;
  Vec3 arms(const Vec3& x) const;

  double amplitude_;
  int fold_;
  std::vector<Wave> waves_;
  double radius_;      ///< R
  double arm_azimuth_; ///< theta_0
};

} // namespace lamella
