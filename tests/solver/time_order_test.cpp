// How the error of time steps falls with their length.
#include "dynamics/semi_implicit.h"
#include "kernels/kernels.h"
#include "runs.h"

namespace lamella {
namespace {

/// One mode u' = -share k^4 u, u(0) = 1, of which the scheme takes k^4 to be the stiffness.
class Mode {
public:
  Mode(double k, double share) : k2_(k * k), rate_(share * k * k * k * k) {}

  double exact(double time) const { return std::exp(-rate_ * time); }

  void step(double dt) {
    double modes[2] = {-rate_ * value_, 0};
    SpectralRow row{};
    row.modes = 1;
    row.kx2 = kx2_;
    row.inv_symbol = inv_symbol_;
    row.k2 = k2_;
    row.scale = row.stiffness = 1;
    row.dt = dt;
    row.ratio = last_ > 0 ? dt / last_ : 0;
    row.blend = SemiImplicit::blend;
    row.least_history = SemiImplicit::least_history;
    row.fade = SemiImplicit::fade;
    kernels().spectral_row(row, modes, rate_before_, increment_, none_, 0);
    value_ += modes[0];
    last_ = dt;
  }

  /// To a time, in so many pairs of steps, the second of each pair longer than the first.
  double after(double time, int pairs) {
    for (int i = 0; i < pairs; i++)
      for (const double part : {0.45, 0.55}) step(part * time / pairs);
    return value_;
  }

private:
  double k2_, rate_, value_ = 1, last_ = 0;
  double rate_before_[2] = {0, 0}, increment_[2] = {0, 0};
  static constexpr double kx2_[2] = {0, 0}, inv_symbol_[2] = {1, 1}, none_[2] = {0, 0};
};

TEST(OrderInTime, OfSoftModesIsTwo) {
  for (const double share : {0.6, 1., 1.4}) {
    auto error = [&](int pairs) {
      Mode mode(1, share);
      return std::abs(mode.after(1, pairs) - mode.exact(1));
    };
    for (const int pairs : {32, 64, 128}) // z from 1/64 to 1/256
      EXPECT_NEAR(std::log2(error(pairs) / error(2 * pairs)), 2, 0.1) << share << ", " << pairs;
  }
}

// Stiff modes are to decay, whatever the step. (The header says how stiff they may be.)
TEST(OrderInTime, StiffModesDecayWhereTheyAreUpToSixTenthsStifferThanTheScheme) {
  for (double z = 1e-3; z < 1e7; z *= 1.5)
    for (const double share : {0.2, 1., 1.55}) {
      Mode mode(std::pow(z, 0.25), share);
      for (int i = 0; i < 200; i++) mode.step(1);
      const double before = std::abs(mode.after(50, 25));
      EXPECT_LE(std::abs(mode.after(200, 100)), before) << "z = " << z << ", share " << share;
    }
  Mode mode(10, 2.1);
  for (int i = 0; i < 200; i++) mode.step(1);
  EXPECT_GT(std::abs(mode.after(200, 100)), 1);
}

/// What halving the longest step changes in the energy at the end, and how much less the next
/// halving does.
struct Halving {
  double first, second;
  double order() const { return std::log2(first / second); }
};

Halving halving(Scene scene, double step) {
  scene.numerics.tolerance = 0.1; // that of the steps does not count
  std::vector<double> energies;
  for (const double length : {step, step / 2, step / 4}) {
    scene.numerics.max_time_step = length;
    energies.push_back(run(scene).back().energy);
  }
  return {energies[0] - energies[1], energies[1] - energies[2]};
}

// Rates are carried off the membrane, so also those of smooth shapes have stiff modes: the order is
// between one and two at these steps. (With shorter ones what counts is what a step does to the
// membrane besides, 1e-7 of the energy.) Measured: 1.22; the steps at the tolerances that scenes
// have are a tenth as long.
TEST(OrderInTime, OfAWholeRunIsBetweenOneAndTwo) {
  const Halving h = halving(scene_of(ellipsoid({0.7, 0.5, 0.4}), 48, 6.4e-3), 2e-4);
  EXPECT_GT(h.order(), 1.05);
  EXPECT_LT(h.order(), 2.1);
  EXPECT_NEAR(h.second, 1.4e-3, 5e-4); // of 28
}

} // namespace
} // namespace lamella
