#include "extremes/verdict.h"

#include "dynamics/simulation.h"
#include "dynamics/stopping.h"
#include "error.h"
#include "extremes/known_answer.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <new>

namespace lamella {

namespace {

using Clock = std::chrono::steady_clock;

// More of either is a hang; no case takes a quarter of them.
constexpr long most_steps = 4000;
constexpr double most_seconds = 400;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

bool all_finite(const Measures& m) {
  return std::ranges::all_of(std::array{m.energy, m.int_KM2, m.P, m.sigma, m.K_multiplier, m.area,
                                        m.volume, m.reduced_volume, m.area_difference, m.max_speed},
                             [](double value) { return std::isfinite(value); });
}

double relative_error(double value, double exact) { return std::abs(value / exact - 1); }

/// What one more state adds.
void add(const Measures& now, CaseResult& result) {
  result.end = now;
  result.finite = result.finite && all_finite(now);
  result.drift = std::max({result.drift, std::abs(now.area_drift), std::abs(now.volume_drift)});
}

/// To the end of the scene, or to that of our patience.
void advance(Simulation& sim, CaseResult& result, const std::function<bool(double time)>& watch) {
  const auto begin = Clock::now();
  Stopping stopping(result.scene.stop);
  add(sim.measures(), result);
  while (sim.time() < result.scene.end() && watch(sim.time()) &&
         !stopping.reason(sim.measures(), result.topology_changes(), sim.ramping(),
                          seconds_since(begin))) {
    if (result.steps == most_steps || seconds_since(begin) > most_seconds) {
      result.ending = Ending::hung;
      return;
    }
    sim.step(result.scene.end());
    result.steps++;
    result.events.assign(sim.events().begin(), sim.events().end());
    add(sim.measures(), result);
    result.energy_rise = std::max(result.energy_rise, sim.measures().energy_rise.value_or(0));
  }
}

/// All of a case but its errors. Throws SceneError and what memory throws.
void carry_out(CaseResult& result, const std::function<bool(double time)>& watch) {
  result.scene = scene_of(result.which);
  try {
    Simulation sim(result.scene);
    result.ending = Ending::ended;
    advance(sim, result, watch);
  } catch (const RunError& e) {
    if (result.ending == Ending::ended) result.ending = Ending::stopped;
    result.message = e.what();
  }
}

} // namespace

CaseResult run_case(const ExtremeCase& which, const std::function<bool(double time)>& watch) {
  CaseResult result;
  result.which = which;
  const auto begin = Clock::now();
  try {
    carry_out(result, watch);
  } catch (const SceneError& e) {
    result.message = e.what();
  } catch (const std::bad_alloc&) {
    result.message = "not enough memory";
  }
  result.seconds = seconds_since(begin);
  if (result.ending != Ending::ended) return result;
  result.exact = known_answer(which, result.end);
  result.errors = {.energy = relative_error(result.end.int_KM2, result.exact.int_KM2),
                   .P = relative_error(result.end.P, result.exact.P),
                   .sigma = relative_error(result.end.sigma, result.exact.sigma)};
  return result;
}

int CaseResult::topology_changes() const {
  return int(std::ranges::count_if(events, &Event::changes_topology));
}

const Event* CaseResult::first_unresolved() const {
  const auto event = std::ranges::find_if(events, &Event::is_under_resolved);
  return event == events.end() ? nullptr : &*event;
}

bool CaseResult::is_right() const {
  const AllowedErrors allowed = allowed_errors(which.known);
  return which.known != Known::nothing && drift <= largest_drift &&
         errors.energy <= allowed.energy && !(errors.P > allowed.multipliers) &&
         !(errors.sigma > allowed.multipliers);
}

Verdict CaseResult::verdict() const {
  if (!finite || ending == Ending::hung) return Verdict::wrong;
  if (ending != Ending::ended && message.empty()) return Verdict::wrong;
  if (ending == Ending::refused) return Verdict::refused;
  if (ending == Ending::stopped) return Verdict::stopped;
  if (is_right()) return Verdict::right;
  if (which.known == Known::nothing && energy_rise <= Simulation::largest_rise &&
      drift <= largest_drift)
    return Verdict::consistent;
  return first_unresolved() ? Verdict::warned : Verdict::wrong;
}

std::string_view to_string(Verdict verdict) {
  constexpr std::string_view words[]{"right",   "consistent", "warned",
                                     "stopped", "refused",    "WRONG"};
  return words[int(verdict)];
}

std::string_view to_string(Ending ending) {
  constexpr std::string_view words[]{"refused", "ended", "stopped", "hung"};
  return words[int(ending)];
}

} // namespace lamella
