#pragma once
#include "dynamics/event.h"
#include "dynamics/measures.h"
#include "exit_code.h"
#include "scene/scene.h"

#include <span>
#include <string>

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

private:
  Measures start_, end_;
  long steps_ = 0;
  double area_drift_, volume_drift_;
};

/// "reached the end, t = 0.001", "settled at t = 0.0003", "stopped at t = 0.0003: the membrane
/// ...".
std::string words_for(const Outcome& outcome, double time);

/// What events say about the accuracy of a run; empty where the grid resolved all.
std::string caution(std::span<const Event> events);

/// The text of summary.txt.
std::string summary(const Scene& scene, const Course& course, std::span<const Event> events,
                    const Outcome& outcome, double seconds);

} // namespace lamella
