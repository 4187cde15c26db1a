#pragma once
#include "energy/surface_term.h"

namespace lamella {

/// modulus int K_M^m K^n dA (Eq. 5), without a factor hidden in the modulus.
template <Term of, int m, int n>
class Monomial : public DensityTerm<Monomial<of, m, n>> {
public:
  static constexpr bool depends_on_K = n > 0;

  /// Energy length^(m + 2 n - 2).
  explicit Monomial(const Coefficient& modulus) : modulus_(modulus) {}

  TermName term() const override { return of; }
  Derivatives needs() const override {
    return m + n <= 1 ? Derivatives::laplacian : n == 0 ? Derivatives::gradient : Derivatives::all;
  }
  bool differs_between_phases() const override { return modulus_.differs(); }

  template <class C, class N>
  N density(const Steps<C>& steps, const N& KM, const N& K) const {
    return modulus_.at(steps) * (power<m>(KM) * power<n>(K));
  }

private:
  template <int exponent, class N>
  static N power(const N& x) {
    if constexpr (exponent == 0)
      return constant<N>(1);
    else if constexpr (exponent == 1)
      return x;
    else
      return power<exponent / 2>(x) * power<exponent - exponent / 2>(x);
  }

  Coefficient modulus_;
};

} // namespace lamella
