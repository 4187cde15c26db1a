#pragma once
#include "energy/smeared_step.h"
#include "scene/scene.h"

namespace lamella {

/// The elastic moduli across the phase boundary, as smooth functions of the distance psi from it:
/// energy density kappa/2 (K_M - C)^2 + kappa_G K. The compliance 1/kappa is what goes linearly
/// with the step (moments of force are continuous there, curvatures are not: like springs in a
/// row).
class PhaseModuli {
public:
  PhaseModuli(const Phase& ld, const Phase& lo, const SmearedStep& accurate,
              const SmearedStep& monotonic, const SmearedStep& of_moments)
      : ld_(ld), lo_(lo), accurate_(accurate), monotonic_(monotonic), of_moments_(of_moments) {}

  /// A function of psi with its first two derivatives.
  struct Course {
    double f, d1, d2;
  };
  struct Value {
    Course kappa, C, kappa_G;
  };
  Value at(double psi) const {
    const SmearedStep::Value s = accurate_.at(psi);
    return {bending(psi), linear(ld_.spontaneous_curvature, lo_.spontaneous_curvature, s),
            linear(ld_.gaussian_modulus, lo_.gaussian_modulus, of_moments_.at(psi))};
  }
  bool differ() const { return !(ld_ == lo_); }
  const Phase& ld() const { return ld_; }
  const Phase& lo() const { return lo_; }

private:
  static Course linear(double ld, double lo, const SmearedStep::Value& s) {
    return {ld + (lo - ld) * s.step, (lo - ld) * s.delta, (lo - ld) * s.slope};
  }
  Course bending(double psi) const {
    const Course y = linear(1 / ld_.bending_modulus, 1 / lo_.bending_modulus, monotonic_.at(psi));
    const double k = 1 / y.f, k2 = k * k;
    return {k, -y.d1 * k2, 2 * y.d1 * y.d1 * k2 * k - y.d2 * k2};
  }

  Phase ld_, lo_;
  SmearedStep accurate_, monotonic_, of_moments_;
};

} // namespace lamella
