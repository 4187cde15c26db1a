#pragma once
#include "levelset/level_set.h"

#include <Eigen/Core>

#include <array>
#include <span>
#include <vector>

namespace lamella {

/// A level set around a point, to second order.
struct Taylor {
  double value;
  Eigen::Vector3d gradient;
  Eigen::Matrix3d hessian;
};

/// The spline's own derivatives at points, in their order.
std::vector<Taylor> taylor(const LevelSet& f, std::span<const Eigen::Vector3d> points);

/// The derivatives of a Hessian by x, y and z.
struct ThirdDerivatives {
  std::array<Eigen::Matrix3d, 3> by;
};

/// Of the spline at points, in their order.
std::vector<ThirdDerivatives> third_derivatives(const LevelSet& f,
                                                std::span<const Eigen::Vector3d> points);

} // namespace lamella
