#pragma once
#include <lamella/energy/surface_term.h>

/// The energy modulus s^2 int [sqrt(1 + (K_M / s)^2) - 1] dA of a membrane that softens: modulus /
/// 2 K_M^2 where it is nearly flat, modulus s |K_M| where it bends much more than s.
class Softening : public lamella::DensityTerm<Softening> {
public:
  static constexpr bool depends_on_K = false;

  /// Energy, and 1/length.
  Softening(double modulus, double s) : modulus_(modulus), s_(s) {}

  lamella::TermName term() const override { return "softening"; }
  lamella::Derivatives needs() const override { return lamella::Derivatives::gradient; }
  bool differs_between_phases() const override { return false; }

  template <class C, class N>
  N density(const lamella::Steps<C>&, const N& KM, const N&) const {
    const N x = (1 / s_) * KM;
    const N root = apply(lamella::Function::sqrt, lamella::constant<N>(1) + x * x);
    return modulus_ * s_ * s_ * (root - lamella::constant<N>(1));
  }

private:
  double modulus_, s_;
};
