#include "energy/scalar_jet.h"

#include "parallel.h"

namespace lamella {

namespace {
using Eigen::Matrix3d;
using Eigen::Vector3d;

} // namespace

Matrix3d curvature_tensor(const SurfaceGeometry& surface, std::size_t i) {
  const double xx = surface.B(0)[i], yy = surface.B(1)[i], zz = surface.B(2)[i],
               xy = surface.B(3)[i], xz = surface.B(4)[i], yz = surface.B(5)[i];
  return (Matrix3d() << xx, xy, xz, xy, yy, yz, xz, yz, zz).finished();
}

/// grad_s grad_s f = P H P + (N.grad f) B, with the Hessian H of f in space.
SurfaceJet<double> jet_along(const Taylor& f, const SurfaceGeometry& surface, std::size_t i) {
  const Vec3 normal = surface.normal(i);
  const Vector3d N(normal[0], normal[1], normal[2]);
  const double along_N = f.gradient.dot(N);
  const Vector3d g = f.gradient - along_N * N;
  SurfaceJet<double> jet = constant<SurfaceJet<double>>(f.value);
  jet.grad = {g[0], g[1], g[2]};
  jet.lap = f.hessian.trace() - N.dot(f.hessian * N) + surface.KM()[i] * along_N;
  if (surface.derivatives() < Derivatives::gradient) return jet;
  const Matrix3d P = Matrix3d::Identity() - N * N.transpose(), B = curvature_tensor(surface, i);
  const Vector3d Bg = B * g;
  jet.B_grad = {Bg[0], Bg[1], Bg[2]};
  jet.B_hess = (B * (P * f.hessian * P + along_N * B)).trace();
  return jet;
}

void find_jets(const LevelSet& f, const SurfaceGeometry& surface,
               std::vector<SurfaceJet<double>>& jets) {
  constexpr std::size_t chunk = 256;
  jets.resize(surface.size());
  const ConstPoints p = surface.points();
  parallel_for(surface.size(), chunk, [&](std::size_t begin, std::size_t end) {
    const std::size_t m = end - begin;
    double t[10 * chunk];
    kernels().taylor(f.view(), m, {p.x + begin, p.y + begin, p.z + begin}, t);
    for (std::size_t i = 0; i < m; i++) {
      const auto at = [&](int q) { return t[q * m + i]; };
      const Taylor taylor{
          at(0),
          {at(1), at(2), at(3)},
          (Matrix3d() << at(4), at(7), at(8), at(7), at(5), at(9), at(8), at(9), at(6)).finished()};
      jets[begin + i] = jet_along(taylor, surface, begin + i);
    }
  });
}

} // namespace lamella
