// Forces on the phase boundary are derivatives of its energy.
#include "energy/line.h"
#include "two_phases.h"

#include <cmath>
#include <gtest/gtest.h>

namespace lamella {
namespace {

using Eigen::Vector3d;

double bump(const Vec3& x) {
  return std::cos(3 * x[0] + 0.3) * std::sin(2.5 * x[1] + 0.7) + 0.4 * std::cos(4 * x[2]);
}
double other_bump(const Vec3& x) {
  return std::sin(2 * x[0] - x[2]) + 0.5 * std::cos(3 * x[1] + 1);
}

/// The spline whose coefficients are a function's values.
LevelSet spline_of(const Grid& grid, double (*f)(const Vec3&)) {
  LevelSet out(grid);
  for (std::size_t i = 0; i < grid.size(); i++) out.coefficients()[i] = f(grid.position(i));
  return out;
}

/// A wavy cut of the triaxial ellipsoid: no symmetry, torsion everywhere.
double generic_cut(const Vector3d& x) {
  return 0.05 - (x[0] + 2 * x[1] - 1.5 * x[2]) / 2.7 + 0.5 * x[0] * x[1] - 0.8 * x[2] * x[2];
}

/// Energy with phi and psi changed by their bumps times an amount.
double varied(const LineEnergy& line, double phi_amount, double psi_amount) {
  TwoPhases s(ellipsoid({0.6, 0.45, 0.35}), generic_cut, 64);
  for (std::size_t i = 0; i < s.grid.size(); i++) {
    s.phi.coefficients()[i] += phi_amount * bump(s.grid.position(i));
    s.psi.coefficients()[i] += psi_amount * other_bump(s.grid.position(i));
  }
  s.measure();
  s.psi.update_nodal();
  s.trace();
  return line.energy(s.boundary);
}

/// dE of the same, from forces and couples.
double predicted(const LineEnergy& line, bool vary_phi, bool vary_psi) {
  const TwoPhases s(ellipsoid({0.6, 0.45, 0.35}), generic_cut, 64);
  const std::vector<Vector3d> places = s.places();
  const auto phi = taylor(s.phi, places), psi = taylor(s.psi, places),
             a = taylor(spline_of(s.grid, bump), places),
             b = taylor(spline_of(s.grid, other_bump), places);
  const std::vector<Vector3d> g = line.forces(s.boundary);
  double dE = 0;
  for (std::size_t i = 0; i < places.size(); i++) {
    const BoundaryPoint& p = s.boundary.points()[i];
    const double slope = phi[i].gradient.norm(), change = vary_psi * b[i].value;
    const double w = -vary_phi * a[i].value / slope; // displacement of the membrane along N
    const double along_n = -(change + w * psi[i].gradient.dot(p.N)) / psi[i].gradient.dot(p.n);
    const double dn_slope = p.n.dot(phi[i].hessian * p.N);
    const double dn_w = -(vary_phi * p.n.dot(a[i].gradient) + w * dn_slope) / slope;
    dE += p.weight * (line.couple(p) * dn_w - g[i].dot(w * p.N + along_n * p.n));
  }
  return dE;
}

TEST(LineEnergy, ForcesAndCouplesAreItsVariation) {
  const double e = 1e-4;
  for (const LineEnergy& line : {LineEnergy{1, 0, 0, 0}, LineEnergy{0, 1, 0, 0},
                                 LineEnergy{0, 0, 1, 0}, LineEnergy{0, 0, 0, 1}}) {
    const double by_phi = (varied(line, e, 0) - varied(line, -e, 0)) / (2 * e);
    const double by_psi = (varied(line, 0, e) - varied(line, 0, -e)) / (2 * e);
    // They are 0.5 to 6 and agree to 7e-7, the difference quotient's own error (2.5e-6 with twice
    // e).
    EXPECT_NEAR(predicted(line, true, false), by_phi, 5e-6);
    EXPECT_NEAR(predicted(line, false, true), by_psi, 5e-6);
  }
}

} // namespace
} // namespace lamella
