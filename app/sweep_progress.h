#pragma once
#include "scene/scene.h"

#include <chrono>
#include <span>
#include <string>

namespace lamella {

/// One line on the terminal that follows a sweep of runs; silent when standard error is not a
/// terminal. The time left is told from the second run on.
class SweepProgress {
public:
  /// Each scene will be run so many times.
  SweepProgress(std::span<const Scene> scenes, int repeats);

  void begin(const Scene& scene);
  /// The run in progress has come to a time.
  void update(double time);
  void end();

private:
  double seconds_of_run() const;
  std::string time_left() const;

  std::size_t runs_, run_ = 0;
  bool terminal_;
  const Scene* scene_ = nullptr;
  std::chrono::steady_clock::time_point begin_, shown_;
  double cost_left_ = 0, cost_done_ = 0, seconds_done_ = 0;
};

} // namespace lamella
