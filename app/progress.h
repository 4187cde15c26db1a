#pragma once
#include "dynamics/measures.h"

#include <chrono>
#include <string>

namespace lamella {

/// One line on the terminal that follows a run; silent when standard error is not a terminal.
class Progress {
public:
  Progress(double end_time, double longest_step);
  ~Progress();
  Progress(const Progress&) = delete;

  void update(const Measures& measures, double next_dt);
  /// Removes the line.
  void clear();

private:
  double steps_left(double time, double dt) const;

  double end_time_, longest_step_;
  bool terminal_, shown_ = false;
  long steps_ = 0;
  std::chrono::steady_clock::time_point start_, last_;
};

/// "3.2 s", "4 min 10 s", "2 h 5 min".
std::string duration_text(double seconds);

} // namespace lamella
