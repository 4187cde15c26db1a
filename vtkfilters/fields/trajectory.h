#pragma once
#include "dynamics/simulation.h"
#include "dynamics/stopping.h"

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace lamella {

/// A vesicle at one time.
struct State {
  Frame frame;
  Measures measures;
  int vesicles = 1; ///< that hold something of their own
};

/// The times at which a scene stores its state, from 0 to its end.
std::vector<double> stored_times(const Scene& scene);

/// A scene over time, computed as far as it is asked for. States at the stored times are kept; they
/// are those of a run of the scene from start to end, whatever is asked for and in which order.
class Trajectory {
public:
  /// Asked before every step, with the time reached; false ends the search for a state there.
  using GoOn = std::function<bool(double time)>;

  /// Throws RunError where the scene cannot start.
  Trajectory(const Scene& scene, const Start& start);

  /// The state at a time, between stored ones by going on from the one before. An earlier one where
  /// the scene's rules or an error ended the run, or `go_on` the search; the next one for that time
  /// goes on from there. Throws RunError where the way from the stored state cannot be gone.
  State at(double time, const GoOn& go_on);
  /// Whether the last search was ended by `go_on`.
  bool interrupted() const { return interrupted_; }

  /// The start and every step of the run, as far as it was computed.
  const std::vector<Measures>& history() const { return history_; }
  /// Of several vesicles each, for the same steps.
  const std::vector<ComponentMeasures>& components() const { return components_; }
  /// What happened until then.
  std::span<const Event> events() const { return simulation_.events(); }
  /// Why the run cannot be continued beyond time(); nothing where it can, or ended by its rules.
  const std::optional<std::string>& failure() const { return failure_; }
  double time() const { return simulation_.time(); }
  const Scene& scene() const { return scene_; }

private:
  /// From a stored state to a time before the next one.
  struct Way {
    Way(const Scene& scene, const Frame& from, double goal);
    bool go(const GoOn& go_on);
    State state() const;
    bool arrived() const;

    double begin, goal;
    Simulation simulation; // its clock is at 0 where the way begins
  };

  bool advance(std::size_t stored, const GoOn& go_on);
  bool ended_by_rule();
  void note_components();
  State now() const {
    return {simulation_.frame(), simulation_.measures(), simulation_.vesicles()};
  }
  State between(std::size_t stored, double time, const GoOn& go_on);

  Scene scene_;
  std::vector<double> times_;
  Simulation simulation_;
  Stopping stopping_;
  std::chrono::steady_clock::duration spent_{}; // in steps
  std::vector<State> stored_;
  std::vector<Measures> history_;
  std::vector<ComponentMeasures> components_;
  bool ended_ = false;
  std::optional<std::string> failure_;
  bool interrupted_ = false;
  std::optional<Way> way_; // one not gone to its end
  std::optional<State> last_between_;
};

} // namespace lamella
