#include "dynamics/stopping.h"

#include <fmt/format.h>

#include <cmath>

namespace lamella {

namespace {
// First steps are so short that little changes in one, and a maximum of the energy is passed
// quickly.
constexpr int steps_to_settle = 5;
} // namespace

bool Stopping::is_at_rest(const Measures& now) const {
  const auto [energy_rate, residual_force, changes, seconds] = rules_;
  if (now.dt == 0 || (energy_rate == 0 && residual_force == 0)) return false;
  const double change = std::abs(now.energy - state_.energy_before);
  return (energy_rate == 0 || change < energy_rate * std::abs(now.energy) * now.dt) &&
         (residual_force == 0 || now.max_speed < residual_force);
}

std::optional<std::string> Stopping::reason(const Measures& now, int topology_changes, bool ramping,
                                            double wall_seconds) {
  state_.steps_at_rest = !ramping && is_at_rest(now) ? state_.steps_at_rest + 1 : 0;
  state_.energy_before = now.energy;
  if (rules_.topology_changes > 0 && topology_changes >= rules_.topology_changes)
    return fmt::format("stopped as asked after {} topology change{}", topology_changes,
                       topology_changes == 1 ? "" : "s");
  if (state_.steps_at_rest >= steps_to_settle) return "settled";
  if (rules_.wall_time > 0 && wall_seconds >= rules_.wall_time)
    return fmt::format("used up its wall-clock budget of {:g} s", rules_.wall_time);
  return {};
}

} // namespace lamella
