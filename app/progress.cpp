#include "progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>

namespace lamella {

namespace {
using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); }
} // namespace

Progress::Progress(double end_time, double longest_step)
    : end_time_(end_time), longest_step_(longest_step), terminal_(isatty(fileno(stderr))), start_(Clock::now()),
      last_(start_) {}

Progress::~Progress() { clear(); }

/// Relaxation slows down as it goes on and steps grow in proportion to time, up to the longest allowed.
double Progress::steps_left(double time, double dt) const {
  if (time >= end_time_ || dt <= 0) return 0;
  const double growing_until = std::clamp(time * longest_step_ / dt, time, end_time_);
  return time / dt * std::log(growing_until / time) + (end_time_ - growing_until) / longest_step_;
}

void Progress::update(const Measures& m, double next_dt) {
  steps_++;
  if (!terminal_ || seconds_since(last_) < 0.1) return;
  last_ = Clock::now();
  const double left = steps_left(m.time, next_dt) * seconds_since(start_) / double(steps_);
  fmt::print(stderr, "\r\033[K t = {:.3e} of {:.3e}   E = {:.4f}   Δt = {:.1e}   step {}   {} left", m.time, end_time_,
             m.energy, m.dt, steps_, duration_text(left));
  std::fflush(stderr);
  shown_ = true;
}

void Progress::clear() {
  if (!shown_) return;
  fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
  shown_ = false;
}

std::string duration_text(double seconds) {
  if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
  const long s = std::lround(seconds);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {} s", s / 60, s % 60);
  return fmt::format("{} h {} min", s / 3600, s / 60 % 60);
}

} // namespace lamella
