#pragma once
#include "dynamics/event.h"
#include "dynamics/measures.h"
#include "extremes/cases.h"
#include "tradeoff/reference.h"

#include <functional>
#include <string>
#include <vector>

namespace lamella {

enum class Ending {
  refused, ///< before its first step
  ended,   ///< at its end time, or as its rules of [stop] say
  stopped, ///< it could not go on
  hung     ///< it took far more steps or time than it should
};

enum class Verdict {
  right,      ///< the known answer, within its bounds; what is held was kept
  consistent, ///< nothing exact is known; the energy fell and what is held was kept
  warned,     ///< neither, but the run said that it was not resolved
  stopped,    ///< with a message
  refused,    ///< with a message
  wrong       ///< none of these: a wrong answer without a word, a number that is none, a hang
};

/// Of what is held, relative.
inline constexpr double largest_drift = 1e-3;

/// What became of a case.
struct CaseResult {
  ExtremeCase which;
  Scene scene;
  Ending ending = Ending::refused;
  std::string message; ///< of a run that was refused or stopped
  Measures end;
  long steps = 0;
  double seconds = 0;
  double energy_rise = 0; ///< largest Measures::energy_rise
  double drift = 0;       ///< of area and volume, relative
  bool finite = true;     ///< all that was measured
  std::vector<Event> events;
  ReferenceState exact;
  Errors errors; ///< of a run that ended; energy stands for int K_M^2 dA

  bool is_right() const;
  Verdict verdict() const;
  int topology_changes() const;
  /// The first place that was not resolved, null where there is none.
  const Event* first_unresolved() const;
};

/// Runs a case. `watch` is told the time before every step and ends the run by returning false.
CaseResult run_case(const ExtremeCase& which, const std::function<bool(double time)>& watch);

std::string_view to_string(Verdict verdict);
std::string_view to_string(Ending ending);

} // namespace lamella
