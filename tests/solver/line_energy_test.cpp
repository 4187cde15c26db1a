// Forces on the phase boundary are derivatives of its energy.
#include "energy/line.h"
#include "two_phases.h"

#include <cmath>
#include <gtest/gtest.h>
#include <memory>

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

constexpr double step = 1e-4;

const Shape shape = ellipsoid({0.6, 0.45, 0.35});

/// Where phi and psi are changed by their bumps times an amount.
PhaseBoundary varied(double phi_amount, double psi_amount) {
  TwoPhases s(shape, generic_cut, 64);
  for (std::size_t i = 0; i < s.grid.size(); i++) {
    s.phi.coefficients()[i] += phi_amount * bump(s.grid.position(i));
    s.psi.coefficients()[i] += psi_amount * other_bump(s.grid.position(i));
  }
  s.measure();
  s.psi.update_nodal();
  s.trace();
  return s.boundary;
}

/// A function of points, along the geodesics across the boundary: its first two derivatives there.
struct Across {
  std::vector<double> first, second;

  template <class Function>
  Across(const TwoPhases& s, Function&& f) {
    constexpr double e = 4e-3;
    constexpr double w1[] = {0, 3. / 4, -3. / 20, 1. / 60},
                     w2[] = {-49. / 18, 3. / 2, -3. / 20, 1. / 90};
    std::vector<Vector3d> at;
    for (const BoundaryPoint& p : s.boundary.points())
      for (int m = -3; m <= 3; m++) {
        const double u = m * e;
        at.push_back(p.x + u * p.n + 0.5 * u * u * p.B_perp * p.N);
      }
    for (int pass = 0; pass < 3; pass++) {
      const std::vector<Taylor> phi = taylor(s.phi, at);
      for (std::size_t i = 0; i < at.size(); i++)
        at[i] -= phi[i].value / phi[i].gradient.squaredNorm() * phi[i].gradient;
    }
    const std::vector<double> values = f(at);
    for (std::size_t i = 0; i < at.size(); i += 7) {
      double d1 = 0, d2 = w2[0] * values[i + 3];
      for (int m = 1; m <= 3; m++) {
        d1 += w1[m] * (values[i + 3 + m] - values[i + 3 - m]) / e;
        d2 += w2[m] * (values[i + 3 + m] + values[i + 3 - m]);
      }
      first.push_back(d1);
      second.push_back(d2 / (e * e));
    }
  }
};

/// dE of the same changes, from forces and couples.
double predicted(const TwoPhases& s, const LineDensity& line, bool vary_phi, bool vary_psi) {
  const std::vector<Vector3d> places = s.places();
  const LevelSet phi_change = spline_of(s.grid, bump), psi_change = spline_of(s.grid, other_bump);
  const auto psi = taylor(s.psi, places), b = taylor(psi_change, places);
  const auto displacement = [&](const std::vector<Vector3d>& at) { // of the membrane along N
    const auto phi = taylor(s.phi, at), a = taylor(phi_change, at);
    std::vector<double> w;
    for (std::size_t i = 0; i < at.size(); i++)
      w.push_back(-vary_phi * a[i].value / phi[i].gradient.norm());
    return w;
  };
  const Across across(s, displacement), KM(s, [&](const std::vector<Vector3d>&at) {
    const auto phi = taylor(s.phi, at), cut = taylor(s.psi, at);
    std::vector<double> values;
    for (std::size_t i = 0; i < at.size(); i++)
      values.push_back(curve_geometry(phi[i], cut[i]).KM());
    return values;
  });
  const std::vector<double> at_boundary = displacement(places);
  const std::vector<CurveGeometry> ribbon(s.boundary.points().begin(), s.boundary.points().end());
  std::vector<double> tau;
  for (const CurveGeometry& p : ribbon) tau.push_back(p.tau_g);
  std::vector<double> dn_B_perp = s.boundary.derivative(tau);
  for (std::size_t i = 0; i < ribbon.size(); i++) // by Codazzi
    dn_B_perp[i] = KM.first[i] - dn_B_perp[i] + ribbon[i].kg * (ribbon[i].B_perp - ribbon[i].kn);
  const LineLoads loads(line, s.boundary, ribbon, dn_B_perp);
  double dE = 0;
  for (std::size_t i = 0; i < places.size(); i++) {
    const BoundaryPoint& p = s.boundary.points()[i];
    const double w = at_boundary[i], change = vary_psi * b[i].value;
    const double along_n = -(change + w * psi[i].gradient.dot(p.N)) / psi[i].gradient.dot(p.n);
    dE += p.weight *
          (loads.couple[i] * (across.first[i] + p.B_perp * along_n) +
           loads.second[i] * across.second[i] - loads.force[i].dot(w * p.N + along_n * p.n));
  }
  return dE;
}

/// All of a density's partial derivatives depend on all curvatures.
class Tangled : public LineDensity {
public:
  Value at(const CurveGeometry& c) const override {
    const double a = 0.3 * c.kg - 0.2 * c.kn + 0.5 * c.tau_g, b = 0.2 * c.B_perp + 0.1 * c.kg;
    Value v;
    v.l = std::exp(a) * std::cos(b);
    const double of_a = v.l, of_b = -std::exp(a) * std::sin(b);
    v.kg = 0.3 * of_a + 0.1 * of_b;
    v.kn = -0.2 * of_a;
    v.tau_g = 0.5 * of_a;
    v.B_perp = 0.2 * of_b;
    return v;
  }
};

TEST(LineEnergy, ForcesAndCouplesAreItsVariation) {
  using D = std::unique_ptr<LineDensity>;
  std::vector<std::pair<std::string, D>> densities;
  const auto add = [&](const char* name, double Line::*modulus) {
    Line line;
    line.*modulus = 1;
    densities.emplace_back(name, std::make_unique<LinePolynomial>(line));
  };
  add("length", &Line::tension);
  add("kg", &Line::geodesic_modulus);
  add("kn", &Line::normal_modulus);
  add("tau_g", &Line::torsion_modulus);
  add("kg^2", &Line::geodesic_square_modulus);
  add("kn^2", &Line::normal_square_modulus);
  add("tau_g^2", &Line::torsion_square_modulus);
  add("B_perp", &Line::perpendicular_modulus);
  densities.emplace_back("all at once", std::make_unique<Tangled>());

  const TwoPhases s(shape, generic_cut, 64);
  const PhaseBoundary by_phi[] = {varied(step, 0), varied(-step, 0)},
                      by_psi[] = {varied(0, step), varied(0, -step)};
  const auto quotient = [](const LineDensity& line, const PhaseBoundary(&at)[2]) {
    const auto energy = [&](const PhaseBoundary& boundary) {
      return boundary.integral([&](const CurveGeometry& c) { return line.at(c).l; });
    };
    return (energy(at[0]) - energy(at[1])) / (2 * step);
  };
  for (const auto& [name, line] : densities) {
    const double phi = quotient(*line, by_phi), psi = quotient(*line, by_psi);
    // Measured 7e-7, the difference quotients' own error.
    EXPECT_NEAR(predicted(s, *line, true, false) / phi, 1, 3e-6) << name;
    EXPECT_NEAR(predicted(s, *line, false, true) / psi, 1, 3e-6) << name;
  }
}

} // namespace
} // namespace lamella
