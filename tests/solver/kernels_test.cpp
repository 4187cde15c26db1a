#include "kernels/kernels.h"
#include "start_surface.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace lamella {
namespace {

/// Quadric x^2/a^2 + y^2/b^2 + z^2/c^2 - 1, which a degree-7 spline holds exactly away from the box
/// sides.
struct Quadric {
  static constexpr double a = 0.5, b = 0.45, c = 0.4;
  LevelSet phi{Grid::cube(48, 1)};

  Quadric() {
    const Grid& g = phi.grid();
    const double variance =
        2. / 3 * g.spacing * g.spacing; // of the spline: x^2 has coefficients x^2 - variance
    for (std::size_t i = 0; i < g.size(); i++) {
      const Vec3 x = g.position(i);
      phi.coefficients()[i] = (x[0] * x[0] - variance) / (a * a) +
                              (x[1] * x[1] - variance) / (b * b) +
                              (x[2] * x[2] - variance) / (c * c) - 1;
    }
  }
};

struct Cloud {
  std::vector<double> x, y, z;
  ConstPoints points() const { return {x.data(), y.data(), z.data()}; }
};

/// Points on the quadric scaled by `factor`; 203 of them, so that the last group of eight is not
/// full.
Cloud on_quadric(double factor) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  Cloud cloud;
  for (int i = 0; i < 203; i++) {
    const double u[3] = {normal(random), normal(random), normal(random)};
    const double r = std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]) / factor;
    cloud.x.push_back(Quadric::a * u[0] / r);
    cloud.y.push_back(Quadric::b * u[1] / r);
    cloud.z.push_back(Quadric::c * u[2] / r);
  }
  return cloud;
}

class EachKernels : public testing::TestWithParam<const Kernels*> {};
INSTANTIATE_TEST_SUITE_P(Kernels, EachKernels, testing::ValuesIn(available_kernels()),
                         [](const auto& info) { return std::string(info.param->name); });

TEST_P(EachKernels, FindCurvaturesOfAnEllipsoid) {
  const Quadric q;
  const Cloud p = on_quadric(1);
  const std::size_t n = p.x.size();
  std::vector<double> out[9];
  for (auto& o : out) o.resize(n);
  GetParam()->jets(q.phi.view(), n, p.points(),
                   {out[0].data(), out[1].data(), out[2].data(), out[3].data(), out[4].data(),
                    out[5].data(), out[6].data(), out[7].data(), out[8].data()});
  for (std::size_t i = 0; i < n; i++) {
    const double a2 = q.a * q.a, b2 = q.b * q.b, c2 = q.c * q.c;
    const double s =
        p.x[i] * p.x[i] / (a2 * a2) + p.y[i] * p.y[i] / (b2 * b2) + p.z[i] * p.z[i] / (c2 * c2);
    const double r2 = p.x[i] * p.x[i] + p.y[i] * p.y[i] + p.z[i] * p.z[i];
    const double K = 1 / (s * s * a2 * b2 * c2),
                 KM = -(a2 + b2 + c2 - r2) / (a2 * b2 * c2 * std::pow(s, 1.5));
    EXPECT_NEAR(out[0][i], 0, 1e-13);
    EXPECT_NEAR(out[1][i], p.x[i] / a2 / std::sqrt(s), 1e-12);
    EXPECT_NEAR(out[4][i], 2 * std::sqrt(s), 1e-11);
    EXPECT_NEAR(out[5][i], KM, 1e-10);
    EXPECT_NEAR(out[6][i], K, 1e-10);
  }
}

TEST_P(EachKernels, AgreeWithEachOther) {
  const Quadric q;
  const Cloud p = on_quadric(1);
  const std::size_t n = p.x.size();
  auto lap_KM = [&](const Kernels& k) {
    std::vector<double> out[9];
    for (auto& o : out) o.resize(n);
    k.jets(q.phi.view(), n, p.points(),
           {out[0].data(), out[1].data(), out[2].data(), out[3].data(), out[4].data(),
            out[5].data(), out[6].data(), out[7].data(), out[8].data()});
    return out[7];
  };
  const std::vector<double> mine = lap_KM(*GetParam()),
                            theirs = lap_KM(*available_kernels().front());
  for (std::size_t i = 0; i < n; i++)
    EXPECT_NEAR(mine[i], theirs[i], 1e-8 * std::abs(theirs[i]) + 1e-8);
}

/// B has the curvatures that are told beside it, gradients lie along the surface. (Second
/// derivatives are tested by what they are for, forces against differences of energies.)
TEST_P(EachKernels, FindWholeJets) {
  const Quadric q;
  const Cloud p = on_quadric(1);
  const std::size_t n = p.x.size();
  std::vector<std::vector<double>> out(31, std::vector<double>(n));
  const auto arrays = [&](std::size_t i) {
    SurfaceArrays a{.phi = out[i].data(),
                    .nx = out[i + 1].data(),
                    .ny = out[i + 2].data(),
                    .nz = out[i + 3].data(),
                    .grad = out[i + 4].data(),
                    .KM = out[i + 5].data(),
                    .K = out[i + 6].data(),
                    .lap_KM = out[i + 7].data(),
                    .slope2 = out.back().data()};
    return a;
  };
  SurfaceArrays full = arrays(0);
  for (int d = 0; d < 3; d++) {
    full.grad_KM[d] = out[8 + d].data();
    full.grad_K[d] = out[11 + d].data();
  }
  for (int c = 0; c < 6; c++) full.B[c] = out[14 + c].data();
  full.B_hess_KM = out[20].data();
  full.lap_K = out[21].data();
  full.B_hess_K = out[22].data();
  for (int c = 0; c < 6; c++) full.hess_KM[c] = out[24 + c].data();
  GetParam()->full_jets(q.phi.view(), n, p.points(), full);
  std::vector<double> lap_KM = out[7];
  GetParam()->jets(q.phi.view(), n, p.points(), arrays(0));
  for (std::size_t i = 0; i < n; i++) {
    EXPECT_NEAR(lap_KM[i], out[7][i], 1e-9 * std::abs(lap_KM[i]) + 1e-9);
    const double* B[6];
    for (int c = 0; c < 6; c++) B[c] = &out[14 + c][i];
    EXPECT_NEAR(*B[0] + *B[1] + *B[2], full.KM[i], 1e-10);
    double square = 0;
    for (int c = 0; c < 6; c++) square += (c < 3 ? 1 : 2) * *B[c] * *B[c];
    EXPECT_NEAR(square, full.KM[i] * full.KM[i] - 2 * full.K[i], 1e-9);
    double trace = 0, with_B = 0;
    for (int c = 0; c < 6; c++) {
      if (c < 3) trace += full.hess_KM[c][i];
      with_B += (c < 3 ? 1 : 2) * *B[c] * full.hess_KM[c][i];
    }
    EXPECT_NEAR(trace, lap_KM[i], 1e-9 * std::abs(lap_KM[i]) + 1e-9);
    EXPECT_NEAR(with_B, full.B_hess_KM[i], 1e-9 * std::abs(with_B) + 1e-9);
    double along_KM = 0, along_K = 0;
    const double N[3] = {full.nx[i], full.ny[i], full.nz[i]};
    for (int d = 0; d < 3; d++) {
      along_KM += N[d] * full.grad_KM[d][i];
      along_K += N[d] * full.grad_K[d][i];
    }
    EXPECT_NEAR(along_KM, 0, 1e-9);
    EXPECT_NEAR(along_K, 0, 1e-9);
  }
}

TEST_P(EachKernels, FindThirdDerivatives) {
  LevelSet f(Grid::cube(16, 1));
  for (std::size_t i = 0; i < f.grid().size(); i++) {
    const Vec3 x = f.grid().position(i);
    f.coefficients()[i] = std::cos(M_PI * x[0] + x[1] * x[2]) * std::sin(2 + x[1]);
  }
  const double e = 1e-4;
  const std::vector<double> x{0.1, 0.1 + e, 0.1 - e, 0.1, 0.1, 0.1, 0.1},
      y{0.2, 0.2, 0.2, 0.2 + e, 0.2 - e, 0.2, 0.2}, z{-.3, -.3, -.3, -.3, -.3, -.3 + e, -.3 - e};
  const std::size_t n = x.size();
  std::vector<double> taylor(10 * n), third(10 * n);
  std::vector<double> values(n);
  GetParam()->taylor(f.view(), n, {x.data(), y.data(), z.data()}, taylor.data());
  GetParam()->values(f.view(), n, {x.data(), y.data(), z.data()}, values.data());
  for (std::size_t i = 0; i < n; i++) EXPECT_NEAR(values[i], taylor[i], 1e-14);
  GetParam()->third(f.view(), n, {x.data(), y.data(), z.data()}, third.data());
  // By which axis which of xx, yy, zz, xy, xz, yz gives xxx, xxy, xxz, xyy, xyz, xzz ...
  constexpr int axis[10]{0, 1, 2, 1, 2, 2, 1, 2, 2, 2}, hessian[10]{0, 0, 0, 3, 3, 4, 1, 1, 5, 2};
  for (int m = 0; m < 10; m++) {
    const double* second = &taylor[(4 + hessian[m]) * n];
    const double exact = (second[1 + 2 * axis[m]] - second[2 + 2 * axis[m]]) / (2 * e);
    EXPECT_NEAR(third[m * n], exact, 1e-5 * std::abs(exact) + 1e-5) << m;
  }
}

TEST_P(EachKernels, FindNearestPoints) {
  const Quadric q;
  const Cloud x = on_quadric(1.1), start = on_quadric(1);
  Cloud p = start;
  std::vector<double> step(x.x.size());
  GetParam()->closest_points(q.phi.view(), x.x.size(), x.points(),
                             {p.x.data(), p.y.data(), p.z.data()}, 8, true, step.data());
  for (std::size_t i = 0; i < step.size(); i++) {
    EXPECT_GE(step[i], 0);
    const double g[3] = {p.x[i] / (q.a * q.a), p.y[i] / (q.b * q.b), p.z[i] / (q.c * q.c)};
    const double d[3] = {x.x[i] - p.x[i], x.y[i] - p.y[i], x.z[i] - p.z[i]};
    EXPECT_NEAR(p.x[i] * g[0] + p.y[i] * g[1] + p.z[i] * g[2], 1, 1e-12);
    EXPECT_NEAR(d[0] * g[1] - d[1] * g[0], 0, 1e-9); // x - p is normal to the surface
    EXPECT_NEAR(d[1] * g[2] - d[2] * g[1], 0, 1e-9);
  }
}

TEST_P(EachKernels, WrapAroundTheBox) {
  LevelSet phi(Grid::cube(16, 1));
  for (std::size_t i = 0; i < phi.grid().size(); i++)
    phi.coefficients()[i] =
        std::cos(M_PI * phi.grid().position(i)[0]) + std::sin(M_PI * phi.grid().position(i)[2]);
  Cloud inside, outside;
  for (double s : {0.93, -0.97, 0.1}) {
    inside.x.push_back(s), inside.y.push_back(0.2), inside.z.push_back(-s);
    outside.x.push_back(s + 2), outside.y.push_back(0.2 - 4), outside.z.push_back(-s - 2);
  }
  std::vector<double> a(3), b(3);
  GetParam()->cubic(phi.view(), 3, inside.points(), a.data());
  GetParam()->cubic(phi.view(), 3, outside.points(), b.data());
  for (int i = 0; i < 3; i++) {
    EXPECT_NEAR(a[i], b[i], 1e-12);
    EXPECT_NEAR(a[i], std::cos(M_PI * inside.x[i]) + std::sin(M_PI * inside.z[i]), 0.1);
  }
}

TEST(LevelSet, FitReproducesSmoothValues) {
  const Grid grid = Grid::cube(32, 1);
  Fourier fourier(grid);
  LevelSet phi(grid);
  std::vector<double> values(grid.size());
  for (std::size_t i = 0; i < grid.size(); i++) {
    const Vec3 x = grid.position(i);
    values[i] = std::cos(2 * M_PI * x[0]) * std::sin(M_PI * x[1]) + 0.3 * std::cos(3 * M_PI * x[2]);
  }
  phi.fit(values, fourier);
  double worst = 0;
  for (std::size_t i = 0; i < grid.size(); i++)
    worst = std::max(worst, std::abs(phi.nodal()[i] - values[i]));
  EXPECT_LT(worst, 1e-6);
}

} // namespace
} // namespace lamella
