#include "dynamics/step_control.h"

#include <algorithm>
#include <cmath>

namespace lamella {

double StepControl::first(double max_force) const {
  return std::min(limits_.longest, 0.02 * limits_.spacing / std::max(max_force, 1e-300));
}

double StepControl::next(double last, double error, double max_speed,
                         double relaxation_time) const {
  const double h = limits_.spacing;
  const double wish =
      last * std::clamp(std::sqrt(limits_.tolerance / std::max(error, 1e-300)), 0.3, 1.3);
  const double bounded = std::min({wish, 0.25 * h / std::max(max_speed, 1e-300), limits_.longest});
  const double floor = std::min({0.25 * relaxation_time, 1.2 * last, limits_.longest});
  return std::max(bounded, floor);
}

} // namespace lamella
