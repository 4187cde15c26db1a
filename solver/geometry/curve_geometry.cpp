#include "geometry/curve_geometry.h"

#include <Eigen/Geometry>

namespace lamella {

/// Along the curve phi and psi are constant: differentiated twice by arc length, grad phi.d_s t =
/// -t.Hess(phi).t gives kn, and the same for psi gives kg, as grad psi has parts along n and N. The
/// shape operator is -d N = -Hess(phi) / |grad phi| in the tangent plane.
CurveGeometry curve_geometry(const Taylor& phi, const Taylor& psi) {
  CurveGeometry c;
  const double slope = phi.gradient.norm();
  c.N = phi.gradient / slope;
  c.t = c.N.cross(psi.gradient).normalized();
  c.n = c.t.cross(c.N);
  const Eigen::Vector3d Ht = phi.hessian * c.t / slope, Hn = phi.hessian * c.n / slope;
  c.kn = -c.t.dot(Ht);
  c.tau_g = -c.n.dot(Ht);
  c.B_perp = -c.n.dot(Hn);
  c.kg = -(c.t.dot(psi.hessian * c.t) + c.kn * psi.gradient.dot(c.N)) / psi.gradient.dot(c.n);
  return c;
}

Eigen::Vector3d step_to_boundary(const Taylor& phi, const Taylor& psi, const CurveGeometry& at) {
  const double along_N = -phi.value / phi.gradient.norm();
  const double along_n = -(psi.value + along_N * psi.gradient.dot(at.N)) / psi.gradient.dot(at.n);
  return along_n * at.n + along_N * at.N;
}

} // namespace lamella
