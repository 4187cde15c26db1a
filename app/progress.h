#pragma once
#include "dynamics/event.h"
#include "dynamics/measures.h"
#include "scene/scene.h"

#include <chrono>
#include <span>
#include <string>

namespace lamella {

/// One line on the terminal that follows a run; silent when standard error is not a terminal. As
/// much as fits the terminal's width, and nothing but text, spaces and carriage returns. Events are
/// said above it.
class Progress {
public:
  /// From a time on; events before it are not said.
  Progress(const Scene& scene, double from);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(const Measures& measures, double next_dt);
  /// Says those of all events so far that have not been said yet.
  void tell(std::span<const Event> all);

private:
  double steps_left(double time, double dt) const;
  void show(const std::string& line);
  void clear();

  double from_, end_time_, longest_step_, spacing_;
  bool terminal_;
  long steps_ = 0;
  std::size_t told_ = 0;
  std::size_t shown_ = 0; ///< characters on the line
  std::chrono::steady_clock::time_point start_, last_;
};

/// To standard output. Neither a full disk nor a reader that went away may end a run, so nothing is
/// thrown.
void say(const std::string& text);
/// The errno of the first time that something could not be said; 0: all was.
int why_unsaid();

/// "3.2 s", "4 min 10 s", "2 h 5 min".
std::string duration_text(double seconds);

} // namespace lamella
