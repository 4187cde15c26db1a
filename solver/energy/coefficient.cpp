#include "energy/coefficient.h"

#include <algorithm>

namespace lamella {

StepProfiles StepProfiles::of_grid(double spacing) {
  constexpr double accurate = 5, moments = 5.5, monotonic = 3.7; // half-widths, in spacings
  return {SmearedStep::accurate(accurate * spacing), SmearedStep::of_moments(moments * spacing),
          SmearedStep::monotonic(monotonic * spacing)};
}

Steps<Univariate> StepProfiles::at(double psi) const {
  const auto course = [psi](const SmearedStep& step) {
    const SmearedStep::Value v = step.at(psi);
    return Univariate{v.step, v.delta, v.slope};
  };
  return {course(accurate), course(moments), course(monotonic)};
}

double StepProfiles::half_width() const {
  return std::max({accurate.half_width(), moments.half_width(), monotonic.half_width()});
}

} // namespace lamella
