#pragma once
#include "dynamics/measures.h"
#include "scene/scene.h"

#include <limits>
#include <optional>
#include <string>

namespace lamella {

/// Ends a run before its end time where the scene's rules say so.
class Stopping {
public:
  /// What is remembered from step to step.
  struct State {
    double energy_before =
        std::numeric_limits<double>::quiet_NaN(); ///< nothing is known of a start
    int steps_at_rest = 0;
  };
  explicit Stopping(const Stop& rules) : rules_(rules) {}
  /// Goes on as the one that had this state.
  Stopping(const Stop& rules, const State& state) : rules_(rules), state_(state) {}
  const State& state() const { return state_; }

  /// To be asked at the start and after every step. Why the run ends here, to complete "The run
  /// ... at t = 0.001"; nothing where it goes on. `ramping`: constraints still change, so that the
  /// vesicle cannot have settled.
  std::optional<std::string> reason(const Measures& now, int topology_changes, bool ramping,
                                    double wall_seconds);

private:
  bool is_at_rest(const Measures& now) const;

  Stop rules_;
  State state_;
};

} // namespace lamella
