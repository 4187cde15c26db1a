#pragma once
#include "dynamics/event.h"
#include "dynamics/measures.h"
#include "exit_code.h"
#include "scene/scene.h"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace lamella {

/// Why the time loop ended.
struct Outcome {
  ExitCode code = success;
  std::string reason; ///< of a run that ended before its time, other than by an interrupt
};

/// What is remembered of a run for its summary.
class Course {
public:
  explicit Course(const Measures& start);
  /// After a step.
  void add(const Measures& measures);

  const Measures& start() const { return start_; }
  const Measures& end() const { return end_; }
  long steps() const { return steps_; }
  /// The largest so far, relative; of the whole area and of those of phases.
  double area_drift() const { return area_drift_; }
  double volume_drift() const { return volume_drift_; }
  /// Of the energy in an undriven step, as Measures::energy_rise, and when.
  double energy_rise() const { return energy_rise_; }
  double time_of_rise() const { return time_of_rise_; }
  /// How many undriven steps raised it by more than rounding.
  long rises() const { return rises_; }
  /// What the energy lost, and what constraints added by their work, in steps in which the membrane
  /// did not part or meet; what these steps dissipated. Both 0 where that is not measured.
  double lost() const { return lost_; }
  double dissipated() const { return dissipated_; }
  /// No point of the membrane went further.
  double way() const { return way_; }
  /// From when on the energy stayed next to what it was at the end.
  double settled_at() const;

private:
  Measures start_, end_;
  long steps_ = 0, rises_ = 0;
  double area_drift_, volume_drift_, energy_rise_ = 0, time_of_rise_ = 0, way_ = 0;
  double lost_ = 0, dissipated_ = 0;
  std::vector<std::array<double, 2>> energies_; // time and energy
};

/// "reached the end, t = 0.001", "settled at t = 0.0003", "stopped at t = 0.0003: the membrane
/// ...".
std::string words_for(const Outcome& outcome, double time);

/// What events say about the accuracy of a run; empty where the grid resolved all.
std::string caution(std::span<const Event> events);

/// A word on an end time that does not fit: nothing can have moved yet, all was over long ago, or a
/// ramp (`ramping`) is still under way. Empty where it fits.
std::string word_on_end_time(const Scene& scene, const Course& course, bool ramping);

/// The text of summary.txt. `vesicles`: at the end; one is not listed.
std::string summary(const Scene& scene, const Course& course, std::span<const Event> events,
                    const Outcome& outcome, bool ramping, double seconds,
                    std::span<const ComponentMeasures> vesicles = {});

} // namespace lamella
