#include "dynamics/multipliers.h"

#include <Eigen/SVD>

namespace lamella {

Eigen::Vector2d solve_scaled(const Eigen::Matrix2d& m, const Eigen::Vector2d& b) {
  constexpr double damping = 1e-5;
  const Eigen::Vector2d row_scale = m.rowwise().norm().cwiseInverse();
  Eigen::Matrix2d scaled = row_scale.asDiagonal() * m;
  const Eigen::Vector2d column_scale = scaled.colwise().norm().transpose().cwiseInverse();
  scaled = scaled * column_scale.asDiagonal();
  const Eigen::JacobiSVD<Eigen::Matrix2d> svd(scaled, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Array2d s = svd.singularValues().array();
  const Eigen::Vector2d along = svd.matrixU().transpose() * row_scale.cwiseProduct(b);
  const Eigen::Vector2d damped = (along.array() * s / (s.square() + damping * damping)).matrix();
  return column_scale.cwiseProduct(svd.matrixV() * damped);
}

Multipliers multipliers_at_rest(const SurfaceIntegrals& integrals) {
  const Eigen::Vector2d x = solve_scaled(integrals.gram.topLeftCorner<2, 2>(), integrals.variation.head<2>());
  return {x[0], x[1]};
}

Multipliers displacement_for(const SurfaceIntegrals& integrals, double volume_change, double area_change) {
  const Eigen::Vector2d wanted{volume_change, -area_change}; // dA = -int K_M u dA
  const Eigen::Vector2d x = solve_scaled(integrals.gram.topLeftCorner<2, 2>(), wanted);
  return {x[0], x[1]};
}

} // namespace lamella
