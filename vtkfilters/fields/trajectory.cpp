#include "fields/trajectory.h"

#include "error.h"

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double rounding = 1e-12; // relative, of times

/// What is still to be done of a ramp from a time on. It goes on from where it is then.
Ramp rest_of(Ramp ramp, double time) {
  std::size_t passed = 0; // targets that the next one has replaced
  while (passed + 1 < ramp.targets.size() && ramp.start_times[passed + 1] <= time) ++passed;
  ramp.targets.erase(ramp.targets.begin(), ramp.targets.begin() + std::ptrdiff_t(passed));
  ramp.start_times.erase(ramp.start_times.begin(),
                         ramp.start_times.begin() + std::ptrdiff_t(passed));
  for (double& start : ramp.start_times) start = std::max(0.0, start - time);
  return ramp;
}

/// The scene from a stored state on, its clock at 0 there.
Scene rest_of(Scene scene, double time) {
  scene.numerics.max_time_step = scene.longest_step();
  scene.shape = {.kind = ShapeKind::frame};
  scene.perturbation = {};
  if (scene.has_phases()) scene.domains = {.kind = DomainsKind::frame};
  scene.curvature_start_time = std::max(0.0, scene.curvature_start_time - time);
  scene.end_time = scene.end() - time;
  if (scene.volume.constraint == Constraint::ramped)
    scene.volume.ramp = rest_of(scene.volume.ramp, time);
  if (scene.area_difference.constraint == Constraint::ramped)
    scene.area_difference.ramp = rest_of(scene.area_difference.ramp, time);
  return scene;
}

} // namespace

std::vector<double> stored_times(const Scene& scene) {
  const int last = scene.output.frames - 1;
  std::vector<double> times;
  for (int n = 0; n < last; ++n) times.push_back(scene.end() * n / last);
  times.push_back(scene.end());
  return times;
}

Trajectory::Trajectory(const Scene& scene, const Start& start)
    : scene_(scene), times_(stored_times(scene)), simulation_(scene, start),
      stopping_(scene.stop), history_{simulation_.measures()} {
  stored_.push_back(now());
  note_components();
}

void Trajectory::note_components() {
  if (simulation_.vesicles() == 1) return;
  const std::vector<ComponentMeasures> now = simulation_.component_measures();
  components_.insert(components_.end(), now.begin(), now.end());
}

State Trajectory::at(double time, const GoOn& go_on) {
  interrupted_ = false;
  time = std::clamp(time, 0.0, times_.back());
  const auto after = std::ranges::upper_bound(times_, time * (1 + rounding));
  const auto before = std::size_t(after - times_.begin()) - 1;
  if (!advance(before, go_on)) return now();
  if (time <= times_[before] * (1 + rounding)) return stored_[before];
  if (time == this->time() || (ended_ && time > this->time())) return now();
  return between(before, time, go_on);
}

/// Until a stored state is there; false where the run ends before, or may not go on.
bool Trajectory::advance(std::size_t stored, const GoOn& go_on) {
  while (stored_.size() <= stored && !ended_) {
    interrupted_ = !go_on(time());
    if (interrupted_) return false;
    if (ended_by_rule()) break;
    const auto begin = Clock::now();
    const double goal = times_[stored_.size()];
    try {
      simulation_.step(goal);
    } catch (const RunError& error) {
      failure_ = error.what();
      ended_ = true;
      break;
    }
    spent_ += Clock::now() - begin;
    history_.push_back(simulation_.measures());
    note_components();
    if (goal - time() <= rounding * goal) stored_.push_back(now());
  }
  return stored_.size() > stored;
}

bool Trajectory::ended_by_rule() {
  const auto changes = std::ranges::count_if(simulation_.events(), &Event::changes_topology);
  const double seconds = std::chrono::duration<double>(spent_).count();
  ended_ = stopping_.reason(simulation_.measures(), int(changes), simulation_.ramping(), seconds)
               .has_value();
  return ended_;
}

State Trajectory::between(std::size_t stored, double time, const GoOn& go_on) {
  if (last_between_ && last_between_->frame.time == time) return *last_between_;
  if (!way_ || way_->goal != time) way_.emplace(scene_, stored_[stored].frame, time);
  interrupted_ = !way_->go(go_on);
  if (interrupted_) return way_->state();
  last_between_ = way_->state();
  way_.reset();
  return *last_between_;
}

Trajectory::Way::Way(const Scene& scene, const Frame& from, double goal)
    : begin(from.time), goal(goal),
      simulation(rest_of(scene, begin), start_of(rest_of(scene, begin), from)) {}

bool Trajectory::Way::go(const GoOn& go_on) {
  while (!arrived()) {
    if (!go_on(begin + simulation.time())) return false;
    simulation.step(goal - begin);
  }
  return true;
}

bool Trajectory::Way::arrived() const {
  const double length = goal - begin;
  return length - simulation.time() <= rounding * length;
}

State Trajectory::Way::state() const {
  State state{simulation.frame(), simulation.measures(), simulation.vesicles()};
  state.measures.time = state.frame.time = arrived() ? goal : begin + simulation.time();
  return state;
}

} // namespace lamella
