#include "sweep_progress.h"

#include "progress.h"
#include "tradeoff/report.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>

namespace lamella {

namespace {
using Clock = std::chrono::steady_clock;
constexpr std::size_t width = 79;
} // namespace

SweepProgress::SweepProgress(std::span<const Scene> scenes, int repeats)
    : runs_(scenes.size() * std::size_t(repeats)), terminal_(isatty(STDERR_FILENO)) {
  for (const Scene& scene : scenes) cost_left_ += repeats * expected_cost(scene);
}

void SweepProgress::begin(const Scene& scene) {
  scene_ = &scene;
  begin_ = Clock::now();
  run_++;
}

void SweepProgress::update(double time) {
  if (!terminal_ || Clock::now() - shown_ < std::chrono::milliseconds(200)) return;
  shown_ = Clock::now();
  std::string line =
      fmt::format("run {} of {}{}   {}, tolerance {:g}   t = {:.1e} of {:.1e}", run_, runs_,
                  time_left(), grid_text(*scene_), scene_->numerics.tolerance, time, scene_->end());
  line.resize(width, ' ');
  std::fprintf(stderr, "\r%s", line.c_str());
}

void SweepProgress::end() {
  seconds_done_ += seconds_of_run();
  cost_done_ += expected_cost(*scene_);
  cost_left_ -= expected_cost(*scene_);
  if (terminal_) std::fprintf(stderr, "\r%*s\r", int(width), "");
}

double SweepProgress::seconds_of_run() const {
  return std::chrono::duration<double>(Clock::now() - begin_).count();
}

std::string SweepProgress::time_left() const {
  if (cost_done_ == 0) return "";
  const double left = seconds_done_ / cost_done_ * cost_left_ - seconds_of_run();
  return fmt::format("   {} left", duration_text(std::max(0., left)));
}

} // namespace lamella
