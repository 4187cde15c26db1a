#pragma once
#include <cmath>
#include <limits>

namespace lamella {

/// A thin film of inner fluid between two sheets of the membrane: a disjoining pressure that falls
/// exponentially with the film's thickness keeps them apart (hydration and undulation forces of
/// lipid bilayers fall that way).
struct Film {
  double pressure_at_contact = 0; ///< 0: no such pressure
  double range = 1;               ///< length over which it falls by a factor e

  bool exists() const { return pressure_at_contact > 0; }
  /// Pushes each sheet outwards.
  double pressure(double thickness) const {
    return pressure_at_contact * std::exp(-thickness / range);
  }
  /// Energy per area of each sheet: half that of the film.
  double density(double thickness) const { return 0.5 * range * pressure(thickness); }
  /// Half of what an explicit step may be at most, sheets moving at their pressure.
  double longest_step(double most_pressure) const {
    return most_pressure > 0 ? 0.5 * range / most_pressure
                             : std::numeric_limits<double>::infinity();
  }
};

} // namespace lamella
