#include "dynamics/multipliers.h"

#include <Eigen/Dense>

namespace lamella {

namespace {

/// Solves the Gram system of (1, K_M), scaled to unit diagonal. Directions in which the scaled matrix is below
/// `ridge` are left alone: K_M constant to 1e-4 is a sphere.
Multipliers solve(const SurfaceIntegrals& integrals, Eigen::Vector2d rhs) {
  constexpr double ridge = 1e-8;
  const Eigen::Matrix2d gram = integrals.gram.topLeftCorner<2, 2>();
  const Eigen::Vector2d scale = gram.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::Matrix2d scaled = scale.asDiagonal() * gram * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(scaled);
  const Eigen::Vector2d along = eigen.eigenvectors().transpose() * scale.cwiseProduct(rhs);
  const Eigen::Array2d lambda = eigen.eigenvalues().array();
  const Eigen::Vector2d damped = (along.array() * lambda / (lambda.square() + ridge * ridge)).matrix();
  const Eigen::Vector2d x = scale.cwiseProduct(eigen.eigenvectors() * damped);
  return {x[0], x[1]};
}

} // namespace

Multipliers multipliers_at_rest(const SurfaceIntegrals& integrals) {
  return solve(integrals, integrals.variation.head<2>());
}

Multipliers displacement_for(const SurfaceIntegrals& integrals, double volume_change, double area_change) {
  return solve(integrals, {volume_change, -area_change}); // dA = -int K_M u dA
}

} // namespace lamella
