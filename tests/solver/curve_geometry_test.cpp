// Curvatures of the phase boundary, against closed forms and dense integration.
#include "line_integrals.h"
#include "two_phases.h"

#include <cmath>
#include <gtest/gtest.h>

namespace lamella {
namespace {

using Eigen::Vector3d;

// ----------------------------------------------------------------------------------------
// small circles

const Vector3d tilted = Vector3d(1, 2, -1.5).normalized();

struct CircleErrors {
  double length, kg, kn, tau_g;
};

/// Errors on the circle of latitude at `height` along the tilted axis of a sphere of radius R.
CircleErrors circle_errors(double R, double height, int nodes) {
  const TwoPhases s(
      sphere(R), [&](const Vector3d& x) { return height - tilted.dot(x); }, nodes);
  EXPECT_EQ(s.boundary.curves(), 1u);
  const double r = std::sqrt(R * R - height * height);
  CircleErrors e{std::abs(s.boundary.length() / (2 * M_PI * r) - 1), 0, 0, 0};
  for (const BoundaryPoint& p : s.boundary.points()) {
    e.kg = std::max(e.kg, std::abs(p.kg * r + height / R));
    e.kn = std::max({e.kn, std::abs(p.kn * R + 1), std::abs(p.B_perp * R + 1)});
    e.tau_g = std::max(e.tau_g, std::abs(p.tau_g * R));
  }
  return e;
}

// Measured, largest of the heights:  32^3    48^3    64^3    96^3
//   length (relative)                7e-5    3e-7    2e-9    8e-13
//   kg r                             4e-3    4e-5    1e-7    2e-10
//   kn R, B_perp R                   4e-4    2e-6    7e-9    2e-10
//   tau_g R                          3e-4    8e-7    3e-9    2e-10
// Orders are 12 and more between any two of them; the spline's own, 8 and 6, would come later.
TEST(SmallCircle, ConvergesToItsCurvaturesAtEighthAndSixthOrder) {
  for (const double height : {0.0, 0.2, -0.45}) {
    const CircleErrors coarse = circle_errors(0.6, height, 32),
                       fine = circle_errors(0.6, height, 64);
    EXPECT_GT(order(coarse.length, fine.length, 2), 8);
    EXPECT_GT(order(coarse.kg, fine.kg, 2), 6);
    EXPECT_GT(order(coarse.kn, fine.kn, 2), 6);
    EXPECT_GT(order(coarse.tau_g, fine.tau_g, 2), 6);
    EXPECT_LT(fine.length, 1e-8);
    EXPECT_LT(fine.kg, 5e-7);
    EXPECT_LT(fine.kn, 3e-8);
    EXPECT_LT(fine.tau_g, 2e-8);
  }
}

// ----------------------------------------------------------------------------------------
// planar cuts of an ellipsoid

struct PlanarCut {
  Vector3d axes, normal;
  double offset;

  double psi(const Vector3d& x) const { return offset - normal.dot(x); }
  /// The ellipsoid's points are axes * y, y on the unit sphere; the cut is a circle there.
  Vector3d pole() const { return axes.cwiseProduct(normal).normalized(); }
  double cosine() const { return offset / axes.cwiseProduct(normal).norm(); }
  Vector3d on_sphere(double c, double alpha) const {
    const auto [u, v] = across(pole());
    return c * pole() + std::sqrt(1 - c * c) * (std::cos(alpha) * u + std::sin(alpha) * v);
  }
  Vector3d surface_normal(const Vector3d& y) const { return y.cwiseQuotient(axes).normalized(); }

  LineIntegrals exact() const {
    constexpr int n = 2000;
    std::vector<Vector3d> x, N;
    for (int i = 0; i < n; i++) {
      const Vector3d y = on_sphere(cosine(), 2 * M_PI * i / n);
      x.push_back(axes.cwiseProduct(y));
      N.push_back(surface_normal(y));
    }
    return dense_integrals(x, N);
  }

  /// int K dA over P-: K dA = d omega / (a b c S^(3/2)), S = sum y_d^2 / a_d^2; Simpson's rule over
  /// the height.
  double exact_int_K() const {
    constexpr int heights = 400, angles = 200;
    double sum = 0;
    for (int k = 0; k <= heights; k++) {
      const double c = cosine() + (1 - cosine()) * k / heights;
      const double w = k == 0 || k == heights ? 1 : k % 2 ? 4 : 2;
      for (int i = 0; i < angles; i++)
        sum += w / std::pow(on_sphere(c, 2 * M_PI * i / angles).cwiseQuotient(axes).norm(), 3);
    }
    return sum * (1 - cosine()) / (3 * heights) * 2 * M_PI / angles / axes.prod();
  }
};

const PlanarCut cuts[] = {{{0.6, 0.45, 0.35}, {0, 0, 1}, 0.1},
                          {{0.6, 0.45, 0.35}, Vector3d(1, 2, -1.5).normalized(), 0.05},
                          {{0.6, 0.45, 0.35}, Vector3d(-1, 0.3, 0.5).normalized(), -0.3}};

TwoPhases cut_ellipsoid(const PlanarCut& cut, int nodes) {
  return {ellipsoid({cut.axes[0], cut.axes[1], cut.axes[2]}),
          [&](const Vector3d& x) { return cut.psi(x); }, nodes};
}

// Measured, largest of the cuts:  32^3    48^3    64^3     96^3
//   length (relative)               2e-6    1e-8    2e-11    2e-13
//   oint kg                         2e-4    5e-7    2e-9     3e-11
//   oint kn                         8e-5    3e-7    1e-9     1e-11
//   oint tau_g                      2e-5    7e-8    8e-11    4e-13
//   oint kg^2 (relative)            2e-4    9e-7    2e-9     3e-11
//   oint tau_g^2                    2e-4    5e-7    2e-9     4e-12
TEST(PlanarCut, HasTheIntegralsOfDenseIntegration) {
  for (const PlanarCut& cut : cuts) {
    const LineIntegrals exact = cut.exact();
    const double allowed[][2] = {{32, 1e-5}, {64, 1e-10}}; // nodes, relative error of the length
    for (const auto& [nodes, length] : allowed) {
      const LineIntegrals sums = integrals(cut_ellipsoid(cut, int(nodes)).boundary);
      EXPECT_NEAR(sums.length / exact.length, 1, length);
      EXPECT_NEAR(sums.kg, exact.kg, 100 * length);
      EXPECT_NEAR(sums.kn, exact.kn, 100 * length);
      EXPECT_NEAR(sums.tau_g, exact.tau_g, 100 * length);
      EXPECT_NEAR(sums.kg2 / exact.kg2, 1, 100 * length);
      EXPECT_NEAR(sums.tau_g2, exact.tau_g2, 100 * length);
    }
  }
}

// The normal of the ellipsoid is along x / axes^2. Measured: K 1e-7, K_M 5e-8, tau_g 2e-8, t 2e-9.
TEST(PlanarCut, HasTheMembranesCurvaturesAndTorsion) {
  for (const PlanarCut& cut : cuts) {
    const Vector3d squares = cut.axes.cwiseAbs2();
    const TwoPhases s = cut_ellipsoid(cut, 64);
    for (const BoundaryPoint& p : s.boundary.points()) {
      const double S = p.x.cwiseQuotient(squares).norm();
      const double K = 1 / (S * S * S * S * squares.prod());
      const Vector3d N = p.x.cwiseQuotient(squares) / S, t = cut.normal.cross(N).normalized();
      const Vector3d dN = t.cwiseQuotient(squares) / S; // d_s N, but for a part along N
      EXPECT_NEAR(p.K(), K, 1e-6);
      EXPECT_NEAR(p.KM(), -(squares.sum() - p.x.squaredNorm()) * K * S, 1e-6);
      EXPECT_NEAR(p.tau_g, -t.cross(N).dot(dN), 1e-6);
      EXPECT_LT((p.t - t).norm(), 1e-7);
    }
  }
}

// int K dA over P- less oint kg dl is 2 pi chi.
TEST(GaussBonnet, CapsOfAnEllipsoid) {
  for (const PlanarCut& cut : cuts) {
    const LineIntegrals sums = integrals(cut_ellipsoid(cut, 64).boundary);
    EXPECT_NEAR(cut.exact_int_K() - sums.kg, 2 * M_PI, 1e-8); // measured 2.5e-9
  }
}

/// Half a torus, cut above its middle: an annulus between two circles, whose int K dA is 0.
TEST(GaussBonnet, AnnulusOfATorus) {
  const double R = 0.5, r = 0.2, height = 0.08, s = height / r, c = std::sqrt(1 - s * s);
  const TwoPhases phases(
      torus(R, r), [&](const Vector3d& x) { return x[2] - height; }, 64);
  ASSERT_EQ(phases.boundary.curves(), 2u);
  double total = 0;
  for (std::size_t i = 0; i < 2; i++) {
    const auto curve = phases.boundary.curve(i);
    const double rho = std::hypot(curve[0].x[0], curve[0].x[1]);
    const double outer = rho > R ? 1 : -1;
    EXPECT_NEAR(rho, R + outer * r * c, 1e-6);
    for (const BoundaryPoint& p : curve) {
      EXPECT_NEAR(p.kg, outer * s / rho, 1e-4);
      EXPECT_NEAR(p.kn, -outer * c / rho, 1e-4);
      EXPECT_NEAR(p.B_perp, -1 / r, 1e-4);
      total += p.weight * p.kg;
    }
  }
  EXPECT_NEAR(total, 0, 1e-5); // measured 1.6e-6
}

// ----------------------------------------------------------------------------------------
// what must not matter

double stretch(const Vec3& x) { return std::exp(0.6 * std::sin(2.5 * x[0] + x[1]) - 0.2 * x[2]); }
double other_stretch(const Vec3& x) { return std::exp(0.7 * std::sin(2 * x[0] - 1.5 * x[2])); }

TEST(Gauge, DoesNotMatter) {
  const PlanarCut& cut = cuts[1];
  const TwoPhases a = cut_ellipsoid(cut, 64);
  std::vector<double> phi = initial_phi(ellipsoid({0.6, 0.45, 0.35}), a.grid);
  for (std::size_t i = 0; i < phi.size(); i++) phi[i] *= stretch(a.grid.position(i));
  const TwoPhases b(
      phi,
      [&](const Vector3d& x) {
        return cut.psi(x) * other_stretch({x[0], x[1], x[2]});
      },
      64);
  EXPECT_EQ(b.boundary.curves(), 1u);
  EXPECT_NEAR(a.boundary.length() / b.boundary.length(), 1, 1e-9); // measured 7e-12
  const std::vector<Vector3d> places = a.places();
  const std::vector<Taylor> phi_b = taylor(b.phi, places), psi_b = taylor(b.psi, places);
  double least = 1e300, most = 0;
  for (std::size_t i = 0; i < places.size(); i++) {
    const BoundaryPoint& p = a.boundary.points()[i];
    const CurveGeometry q = curve_geometry(phi_b[i], psi_b[i]);
    EXPECT_LT((p.t - q.t).norm(), 1e-7); // measured 3e-9, curvatures 6e-8
    EXPECT_NEAR(p.kg, q.kg, 5e-7);
    EXPECT_NEAR(p.kn, q.kn, 5e-7);
    EXPECT_NEAR(p.tau_g, q.tau_g, 5e-7);
    EXPECT_NEAR(p.B_perp, q.B_perp, 5e-7);
    least = std::min(least, psi_b[i].gradient.norm());
    most = std::max(most, psi_b[i].gradient.norm());
  }
  EXPECT_GT(most, 3 * least);
}

} // namespace
} // namespace lamella
