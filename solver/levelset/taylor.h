#pragma once
#include "levelset/level_set.h"

#include <Eigen/Core>

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

} // namespace lamella
