#include "progress.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>
#include <vector>

namespace lamella {

namespace {

using Clock = std::chrono::steady_clock;

int unsaid = 0; // see why_unsaid()

double seconds_since(Clock::time_point t) {
  return std::chrono::duration<double>(Clock::now() - t).count();
}

/// Characters that a line of the terminal holds without the cursor going to the next.
std::size_t line_width() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return (known ? size.ws_col : 80) - 1;
}

} // namespace

Progress::Progress(const Scene& scene, double from)
    : from_(from), end_time_(scene.end()), longest_step_(scene.longest_step()),
      spacing_(scene.grid().spacing), terminal_(isatty(STDERR_FILENO)), start_(Clock::now()),
      last_(start_) {}

Progress::~Progress() { clear(); }

void Progress::tell(std::span<const Event> all) {
  for (; told_ < all.size(); told_++) {
    if (from_ > 0 && all[told_].time <= from_) continue;
    clear();
    say(to_text(all[told_], spacing_) + '\n');
  }
}

/// Relaxation slows down as it goes on and steps grow in proportion to time, up to the longest
/// allowed.
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
  const std::size_t width = line_width();
  std::vector<std::string> parts{fmt::format("t = {:.3e} of {:.3e}", m.time, end_time_),
                                 fmt::format("   {} left", duration_text(left)),
                                 fmt::format("   E = {:.4f}", m.energy)};
  if (m.phases)
    parts.push_back(fmt::format("   line {:.4f}   domains {} Ld, {} Lo", m.phases->line_length,
                                m.phases->domains_Ld, m.phases->domains_Lo));
  parts.push_back(fmt::format("   dt = {:.1e}", m.dt));
  parts.push_back(fmt::format("   step {}", steps_));
  std::string line;
  for (const std::string& part : parts) {
    if (line.size() + part.size() > width) break;
    line += part;
  }
  show(line);
}

/// Over what was there, which may have been longer.
void Progress::show(const std::string& line) {
  const std::string padded = fmt::format("\r{:<{}}", line, std::min(shown_, line_width()));
  std::fputs(padded.c_str(), stderr);
  std::fflush(stderr);
  shown_ = line.size();
}

void Progress::clear() {
  if (shown_ == 0) return;
  show("");
  std::fputs("\r", stderr);
}

void say(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  if (std::fflush(stdout) != 0 && unsaid == 0) unsaid = errno;
}

int why_unsaid() { return unsaid; }

std::string duration_text(double seconds) {
  if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
  const long s = std::lround(seconds);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {} s", s / 60, s % 60);
  return fmt::format("{} h {} min", s / 3600, s / 60 % 60);
}

} // namespace lamella
