#pragma once
#include "dynamics/measures.h"

#include <chrono>
#include <string>

namespace lamella {

/// One line on the terminal that follows a run; silent when standard error is not a terminal. As
/// much as fits the terminal's width, and nothing but text, spaces and carriage returns.
class Progress {
public:
  Progress(double end_time, double longest_step);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(const Measures& measures, double next_dt);

private:
  double steps_left(double time, double dt) const;
  void show(const std::string& line);

  double end_time_, longest_step_;
  bool terminal_;
  long steps_ = 0;
  std::size_t shown_ = 0; ///< characters on the line
  std::chrono::steady_clock::time_point start_, last_;
};

/// "3.2 s", "4 min 10 s", "2 h 5 min".
std::string duration_text(double seconds);

} // namespace lamella
