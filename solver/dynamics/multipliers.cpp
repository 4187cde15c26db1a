#include "dynamics/multipliers.h"

#include <Eigen/LU>

namespace lamella {

Eigen::Vector2d solve_scaled(const Eigen::Matrix2d& m, const Eigen::Vector2d& b) {
  constexpr double damping = 1e-4;
  const Eigen::Vector2d row_scale = m.rowwise().norm().cwiseInverse();
  Eigen::Matrix2d scaled = row_scale.asDiagonal() * m;
  const Eigen::Vector2d column_scale = scaled.colwise().norm().transpose().cwiseInverse();
  scaled = scaled * column_scale.asDiagonal();
  const Eigen::Matrix2d normal =
      scaled.transpose() * scaled + damping * damping * Eigen::Matrix2d::Identity();
  return column_scale.cwiseProduct(normal.inverse() *
                                   (scaled.transpose() * row_scale.cwiseProduct(b)));
}

Multipliers multipliers_at_rest(const SurfaceIntegrals& integrals) {
  const Eigen::Vector2d x =
      solve_scaled(integrals.gram.topLeftCorner<2, 2>(), integrals.variation.head<2>());
  return {x[0], x[1]};
}

Multipliers displacement_for(const SurfaceIntegrals& integrals, double volume_change,
                             double area_change) {
  const Eigen::Vector2d wanted{volume_change, -area_change}; // dA = -int K_M u dA
  const Eigen::Vector2d x = solve_scaled(integrals.gram.topLeftCorner<2, 2>(), wanted);
  return {x[0], x[1]};
}

} // namespace lamella
