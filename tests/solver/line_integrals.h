#pragma once
#include "geometry/phase_boundary.h"

#include <Eigen/Geometry>

#include <cmath>
#include <utility>

namespace lamella {

struct LineIntegrals {
  double length = 0, kg = 0, kn = 0, tau_g = 0, kg2 = 0, tau_g2 = 0;
};

inline LineIntegrals integrals(const PhaseBoundary& boundary) {
  using P = BoundaryPoint;
  return {boundary.length(),
          boundary.integral([](const P& p) { return p.kg; }),
          boundary.integral([](const P& p) { return p.kn; }),
          boundary.integral([](const P& p) { return p.tau_g; }),
          boundary.integral([](const P& p) { return p.kg * p.kg; }),
          boundary.integral([](const P& p) { return p.tau_g * p.tau_g; })};
}

/// Derivatives of a periodic function of alpha in [0, 2 pi) known at n equally spaced places.
inline std::vector<Eigen::Vector3d> derivative(const std::vector<Eigen::Vector3d>& f) {
  constexpr double w[] = {0, 4. / 5, -1. / 5, 4. / 105, -1. / 280};
  const int n = int(f.size());
  std::vector<Eigen::Vector3d> out(n, Eigen::Vector3d::Zero());
  for (int i = 0; i < n; i++)
    for (int m = 1; m <= 4; m++)
      out[i] += w[m] * n / (2 * M_PI) * (f[(i + m) % n] - f[(i + n - m) % n]);
  return out;
}

/// From points of a curve, counter-clockwise around P-, and the membrane's normals there.
inline LineIntegrals dense_integrals(const std::vector<Eigen::Vector3d>& x,
                                     const std::vector<Eigen::Vector3d>& N) {
  const std::vector<Eigen::Vector3d> dx = derivative(x), ddx = derivative(dx), dN = derivative(N);
  LineIntegrals sum;
  for (std::size_t i = 0; i < x.size(); i++) {
    const double speed = dx[i].norm(), dl = 2 * M_PI / double(x.size()) * speed;
    const Eigen::Vector3d n = dx[i].cross(N[i]) / speed;
    const double kg = n.dot(ddx[i]) / (speed * speed), tau_g = -n.dot(dN[i]) / speed;
    sum.length += dl;
    sum.kg += kg * dl;
    sum.kn += N[i].dot(ddx[i]) / (speed * speed) * dl;
    sum.tau_g += tau_g * dl;
    sum.kg2 += kg * kg * dl;
    sum.tau_g2 += tau_g * tau_g * dl;
  }
  return sum;
}

/// u, v with {u, v, axis} right-handed and orthonormal.
inline std::pair<Eigen::Vector3d, Eigen::Vector3d> across(const Eigen::Vector3d& axis) {
  const Eigen::Vector3d u = axis.unitOrthogonal();
  return {u, axis.cross(u)};
}

/// Of convergence, grids differing by a ratio.
inline double order(double coarse, double fine, double ratio) {
  return std::log(coarse / fine) / std::log(ratio);
}

} // namespace lamella
