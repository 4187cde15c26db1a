// The narrow band, extension, components, Fourier rows, step control.
#include "dynamics/step_control.h"
#include "levelset/extension.h"
#include "levelset/topology.h"
#include "parallel.h"
#include "start_surface.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace lamella {
namespace {

const Grid grid40 = Grid::cube(40, 1);

TEST(NarrowBand, HoldsEveryNodeInReachWithItsDistance) {
  const double R = 0.55;
  const StartSurface s(moved(sphere(R), {0.013, -0.02, 0.007}, 0), grid40);
  const double reach = 4.2 * grid40.spacing;
  for (std::size_t i = 0; i < grid40.size(); i++) {
    const Vec3 x = grid40.position(i);
    const double d = std::hypot(x[0] - 0.013, x[1] + 0.02, x[2] - 0.007) - R;
    const int slot = s.band.slot(i);
    if (std::abs(d) < reach - 0.1 * grid40.spacing) {
      ASSERT_GE(slot, 0) << d / grid40.spacing;
      EXPECT_NEAR(s.band.distance()[slot], d, 1e-5);
      EXPECT_EQ(s.band.node()[slot], int(i));
    } else if (std::abs(d) > reach + 1e-3 * grid40.spacing) {
      EXPECT_EQ(slot, -1);
    }
  }
}

TEST(NarrowBand, FollowsAMovingMembrane) {
  StartSurface s(moved(ellipsoid({0.55, 0.4, 0.3}), {0, 0, 0}, 20), grid40);
  for (int step = 0; step < 6; step++) { // grows by 0.3 spacings a step
    for (double& c : s.phi.coefficients()) c -= 0.3 * grid40.spacing;
    s.measure();
  }
  s.measure(); // one Newton step a measurement: far nodes settle once the membrane rests
  s.measure();
  NarrowBand fresh(grid40, 4.2);
  fresh.update(s.phi);
  ASSERT_NEAR(double(fresh.size()), double(s.band.size()), 0.005 * double(fresh.size()));
  for (std::size_t i = 0; i < fresh.size(); i++) {
    const int slot = s.band.slot(fresh.node()[i]);
    if (slot < 0 || std::abs(fresh.distance()[i] - 0.75 * grid40.spacing) > 2.75 * grid40.spacing)
      continue;
    EXPECT_NEAR(s.band.distance()[slot], fresh.distance()[i], 1e-4 * grid40.spacing);
  }
}

TEST(NarrowBand, TakesInASecondMembrane) {
  const Shape a = moved(sphere(0.3), {-0.45, 0, 0}, 0);
  StartSurface s(a, grid40);
  const std::size_t alone = s.band.size();
  const std::vector<double> other = initial_phi(moved(sphere(0.25), {0.5, 0, 0}, 0), grid40);
  std::vector<double> both(s.phi.nodal().begin(), s.phi.nodal().end());
  for (std::size_t i = 0; i < both.size(); i++) both[i] = std::min(both[i], other[i]);
  s.phi.fit(both, s.fourier);
  s.measure();
  EXPECT_GT(s.band.size(), alone + 1000);
  EXPECT_EQ(count_components(grid40, s.phi.nodal()), 2);
}

TEST(Extension, KeepsAConstantAndIsMirrorSymmetric) {
  const StartSurface s(sphere(0.5), grid40);
  Extension extension(grid40);
  extension.prepare(s.band, s.geometry.sampled());
  std::vector<double> one(s.band.size(), 0.), even(s.band.size(), 0.);
  for (std::size_t i = 0; i < s.geometry.size(); i++) {
    const Vec3 p = s.geometry.point(i);
    one[s.geometry.entry()[i]] = 3;
    even[s.geometry.entry()[i]] = p[2] * p[2] + std::abs(p[0]);
  }
  const std::size_t plane = 40 * 40;
  std::vector<double> out(plane), mirrored(plane);
  extension.complete(0, one);
  extension.fill(s.band, one);
  for (int k = 0; k < 40; k++) {
    extension.plane(k, out.data());
    for (double v : out) EXPECT_NEAR(v, 3, 1e-12);
  }
  extension.complete(0, even);
  extension.fill(s.band, even);
  for (int k = 0; k < 20; k++) {
    extension.plane(k, out.data());
    extension.plane(39 - k, mirrored.data());
    for (std::size_t i = 0; i < plane; i++) EXPECT_NEAR(out[i], mirrored[i], 1e-9);
  }
}

TEST(Components, AreCountedAcrossTheSidesOfTheBox) {
  const Grid g = Grid::cube(16, 1);
  auto count = [&](auto inside) {
    std::vector<double> phi(g.size());
    for (std::size_t i = 0; i < g.size(); i++) phi[i] = inside(g.position(i)) ? -1 : 1;
    return count_components(g, phi);
  };
  EXPECT_EQ(count([](const Vec3&) { return false; }), 0);
  EXPECT_EQ(count([](const Vec3&) { return true; }), 1);
  EXPECT_EQ(count([](const Vec3& x) { return std::abs(x[0]) > 0.7; }), 1);
  EXPECT_EQ(count([](const Vec3& x) { return std::abs(x[1]) > 0.7; }), 1);
  EXPECT_EQ(count([](const Vec3& x) { return std::abs(x[2]) > 0.7; }), 1);
  EXPECT_EQ(count([](const Vec3& x) { return std::abs(std::abs(x[2]) - 0.5) < 0.2; }), 2);
  EXPECT_EQ(count([](const Vec3& x) {
              return std::abs(std::abs(x[0]) - 0.5) < 0.2 && std::abs(x[1]) < 0.5;
            }),
            2);
  EXPECT_EQ(count([](const Vec3& x) {
              return std::hypot(x[0], x[1]) > 0.5 && std::hypot(x[0], x[1]) < 0.8;
            }),
            1);
}

TEST(Fourier, ForwardAndBackwardIsIdentityForOddShapesToo) {
  const Grid g{{24, 16, 40}, 0.1};
  Fourier fourier(g);
  std::vector<double> in(g.size()), out(g.size());
  for (std::size_t i = 0; i < in.size(); i++)
    in[i] = std::sin(0.37 * double(i)) + 0.1 * double(i % 7);
  const std::size_t plane = 24 * 16;
  fourier.apply([&](int k, double* p) { std::copy_n(&in[k * plane], plane, p); },
                [](int, int, std::complex<double>*) {},
                [&](int k, const double* p) { std::copy_n(p, plane, &out[k * plane]); });
  for (std::size_t i = 0; i < in.size(); i++) EXPECT_NEAR(out[i] / double(g.size()), in[i], 1e-13);
}

TEST(Fourier, WaveNumbersDifferentiate) {
  const Grid g{{24, 16, 40}, 0.1};
  Fourier fourier(g);
  const double kz = 3 * 2 * M_PI / g.length(2), ky = 2 * 2 * M_PI / g.length(1);
  auto f = [&](std::size_t i) {
    return std::cos(kz * g.position(i)[2]) + std::sin(ky * g.position(i)[1]);
  };
  const std::size_t plane = 24 * 16;
  double worst = 0;
  fourier.apply(
      [&](int k, double* p) {
        for (std::size_t i = 0; i < plane; i++) p[i] = f(k * plane + i);
      },
      [&](int jy, int jz, std::complex<double>* row) {
        for (int jx = 0; jx < fourier.row_modes(); jx++)
          row[jx] *= (fourier.k2(0, jx) + fourier.k2(1, jy) + fourier.k2(2, jz)) / double(g.size());
      },
      [&](int k, const double* p) {
        if (k != 7) return;
        for (std::size_t i = 0; i < plane; i++) {
          const Vec3 x = g.position(k * plane + i);
          worst = std::max(worst, std::abs(p[i] - kz * kz * std::cos(kz * x[2]) -
                                           ky * ky * std::sin(ky * x[1])));
        }
      });
  EXPECT_LT(worst, 1e-10);
}

TEST(StepControl, GrowsAndShrinksWithinBounds) {
  constexpr double never = 0; // nothing keeps steps from getting short
  const StepControl control({0.005, 0.03, 1e-4});
  EXPECT_DOUBLE_EQ(control.next(1e-5, 1e-9, 1, never), 1.3e-5);
  EXPECT_DOUBLE_EQ(control.next(1e-5, 0.02, 1, never), 0.5e-5);
  EXPECT_DOUBLE_EQ(control.next(9e-5, 1e-9, 1, never), 1e-4);
  EXPECT_DOUBLE_EQ(control.next(1e-5, 0.005, 750, never), 1e-5);
  EXPECT_DOUBLE_EQ(control.next(1e-5, 1e-9, 3000, never), 0.25e-5);
}

TEST(StepControl, DoesNotGoBelowWhatABumpTakesToRelax) {
  const StepControl control({0.005, 0.03, 1e-4});
  const double relaxation = std::pow(0.03, 4), floor = 0.25 * relaxation;
  EXPECT_DOUBLE_EQ(control.next(floor, 1e9, 1e9, relaxation), floor);
  EXPECT_DOUBLE_EQ(control.next(floor / 10, 1e9, 1e9, relaxation), 1.2 * floor / 10);
}

TEST(Parallel, SumsDoNotDependOnTheNumberOfThreads) {
  auto sum = [] {
    return parallel_sum<double>(100001, 64, [](std::size_t begin, std::size_t end) {
      double s = 0;
      for (std::size_t i = begin; i < end; i++) s += 1 / (1 + double(i));
      return s;
    });
  };
  set_thread_count(1);
  const double one = sum();
  set_thread_count(3);
  EXPECT_EQ(sum(), one);
  set_thread_count(0);
}

} // namespace
} // namespace lamella
