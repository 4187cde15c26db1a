#pragma once
#include "energy/smeared_step.h"
#include "energy/surface_jet.h"

#include <array>

namespace lamella {

/// How a modulus goes from one phase to the other: which step it follows, across a strip of a few
/// spacings along the phase boundary.
enum class Profile {
  accurate,  ///< linearly with SmearedStep::accurate
  moments,   ///< linearly with SmearedStep::of_moments
  monotonic, ///< linearly with SmearedStep::monotonic, for moduli that must keep their sign
  compliance ///< its inverse linearly with SmearedStep::monotonic, as springs in a row
};

/// The three steps at a place, 0 in Ld and 1 in Lo.
template <class N>
struct Steps {
  N accurate, moments, monotonic;
};

/// The three steps, smeared over widths that suit the spacing of a grid.
struct StepProfiles {
  SmearedStep accurate, moments, monotonic;

  static StepProfiles of_grid(double spacing);
  double half_width() const; ///< of the widest

  /// At a distance from the boundary, < 0 in Ld.
  Steps<Univariate> at(double psi) const;
};

/// A modulus that may differ between the phases; with one phase both are the same.
struct Coefficient {
  double ld = 0, lo = 0;
  Profile profile = Profile::accurate;

  bool vanishes() const { return ld == 0 && lo == 0; }
  bool differs() const { return ld != lo; }

  template <class N>
  N at(const Steps<N>& steps) const {
    if (!differs()) return constant<N>(ld);
    if (profile == Profile::compliance) return reciprocal(between(1 / ld, 1 / lo, steps.monotonic));
    return between(ld, lo, of(steps));
  }
  /// Its derivative by the distance, from those of the steps; not for compliances.
  template <class N>
  N slope(const Steps<N>& slopes) const {
    return (lo - ld) * of(slopes);
  }

private:
  template <class N>
  const N& of(const Steps<N>& steps) const {
    return profile == Profile::accurate  ? steps.accurate
           : profile == Profile::moments ? steps.moments
                                         : steps.monotonic;
  }
  template <class N>
  static N between(double from, double to, const N& step) {
    return (to - from) * step + from;
  }
};

} // namespace lamella
