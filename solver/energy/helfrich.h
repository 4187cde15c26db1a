#pragma once
#include "energy/surface_term.h"
#include "scene/scene.h"

namespace lamella {

/// Bending energy kappa/2 int (K_M - C)^2 dA (Helfrich). Where kappa and C are constant
/// F = kappa [Lap_s K_M + K_M^3/2 - 2 K_M K + 2 C K - C^2 K_M / 2], dE = int F u dA (Eq. 80).
class Helfrich : public DensityTerm<Helfrich> {
public:
  static constexpr bool depends_on_K = false;

  /// Energy, and 1/length in the sign of K_M (-2 on the unit sphere).
  Helfrich(const Coefficient& bending_modulus, const Coefficient& spontaneous_curvature)
      : kappa_(bending_modulus), C_(spontaneous_curvature) {}

  TermName term() const override { return Term::bending; }
  Derivatives needs() const override { return Derivatives::laplacian; }
  bool differs_between_phases() const override { return kappa_.differs() || C_.differs(); }

  template <class C, class N>
  N density(const Steps<C>& steps, const N& KM, const N&) const {
    const N off = KM - C_.at(steps);
    return C(0.5 * kappa_.at(steps)) * (off * off);
  }

private:
  Coefficient kappa_, C_;
};

/// At a point of a membrane of one phase.
inline double bending_density(const SurfaceModuli& moduli, double KM) {
  const double off = KM - moduli.spontaneous_curvature;
  return 0.5 * moduli.bending_modulus * off * off;
}

} // namespace lamella
