#pragma once
#include "energy/surface_term.h"

namespace lamella {

/// modulus int |grad_s K_M|^2 dA, C(4,4) of Eq. 5.
class Gradient : public DensityTerm<Gradient> {
public:
  static constexpr bool depends_on_K = false;

  /// Energy length^2.
  explicit Gradient(const Coefficient& modulus) : modulus_(modulus) {}

  TermName term() const override { return Term::gradient; }
  Derivatives needs() const override { return Derivatives::sixth; }
  bool differs_between_phases() const override { return modulus_.differs(); }
  Coefficient of_gradient() const override { return modulus_; }

  template <class C, class N>
  N density(const Steps<C>&, const N&, const N&) const {
    return constant<N>(0);
  }

private:
  Coefficient modulus_;
};

} // namespace lamella
