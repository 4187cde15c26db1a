#pragma once

namespace lamella {

/// Chooses time steps from the local error of the last one.
class StepControl {
public:
  struct Limits {
    double tolerance; ///< local error allowed, rms over the membrane, in grid spacings
    double spacing;   ///< h
    double longest;   ///< upper bound of the step
  };
  explicit StepControl(const Limits& limits) : limits_(limits) {}

  /// The first step of a run or after a restart: a fiftieth of a spacing at the largest driving
  /// speed.
  double first(double max_force) const;

  /// Step after one of length `last` that made the error `error` (spacings), with the membrane
  /// moving at most at max_speed: grows by at most 1.3, and never below a quarter of the time that
  /// a bump of the size of the grid takes to relax, once there; going below resolves noise only.
  double next(double last, double error, double max_speed, double relaxation_time) const;

private:
  Limits limits_;
};

} // namespace lamella
