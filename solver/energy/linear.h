#pragma once
#include "energy/surface_term.h"
#include "scene/scene.h"

namespace lamella {

/// linear_modulus int K_M dA, C(1) of Eq. 5, where it differs between two phases.
///
/// A modulus a beside a bending modulus kappa is a change of the spontaneous curvature C by -a /
/// kappa, and an energy per area. Across the strip along the phase boundary these two follow their
/// steps, and not a itself: with a smeared the membrane gains less than it should, by an energy of
/// first order in the width of the strip (2e-3 of the whole at 64^3).
class Linear : public DensityTerm<Linear> {
public:
  static constexpr bool depends_on_K = false;

  Linear(const SurfaceModuli& ld, const SurfaceModuli& lo)
      : kappa_{ld.bending_modulus, lo.bending_modulus, Profile::compliance},
        C_{ld.spontaneous_curvature, lo.spontaneous_curvature, Profile::accurate},
        shifted_C_{shifted(ld), shifted(lo), Profile::accurate}, per_area_{per_area(ld),
                                                                           per_area(lo),
                                                                           Profile::accurate} {}

  TermName term() const override { return Term::linear; }
  Derivatives needs() const override { return Derivatives::laplacian; }
  bool differs_between_phases() const override { return true; }

  template <class C, class N>
  N density(const Steps<C>& steps, const N& KM, const N&) const {
    const C kappa = kappa_.at(steps), before = C_.at(steps), after = shifted_C_.at(steps);
    const C rest = C(0.5 * kappa) * C(after * after - before * before) + per_area_.at(steps);
    return C(kappa * C(before - after)) * KM + rest;
  }

private:
  static double shifted(const SurfaceModuli& m) {
    return m.spontaneous_curvature - m.linear_modulus / m.bending_modulus;
  }
  static double per_area(const SurfaceModuli& m) {
    const double C = m.spontaneous_curvature, after = shifted(m);
    return 0.5 * m.bending_modulus * (C * C - after * after);
  }

  Coefficient kappa_, C_, shifted_C_, per_area_;
};

} // namespace lamella
