#include "dynamics/simulation.h"
#include "error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

// Interrupting a simulation and going on.
namespace lamella {

namespace {

[[noreturn]] void refuse(std::string_view what) {
  throw RunError(fmt::format("the stored state does not fit the scene: {}", what));
}

void check_size(std::string_view what, std::size_t size, std::size_t expected) {
  if (size != expected) refuse(fmt::format("{} has {} values, not {}", what, size, expected));
}

/// Nodes of the grid in ascending order, their nearest points in the box.
void check_fits(const NarrowBand::State& band, const Grid& grid) {
  if (band.node.empty()) refuse("there is no membrane");
  if (band.node.front() < 0 || std::size_t(band.node.back()) >= grid.size() ||
      !std::ranges::is_sorted(band.node, std::ranges::less_equal{}))
    refuse("nodes out of order");
  const Array<double>* points[]{&band.x, &band.y, &band.z};
  for (int d = 0; d < 3; d++) {
    check_size("the band", points[d]->size(), band.node.size());
    const double side = 0.5 * grid.length(d);
    if (!std::ranges::all_of(*points[d], [=](double x) { return std::abs(x) <= side; }))
      refuse("the membrane leaves the box");
  }
}

void check_fits(const SemiImplicit::Memory& memory, const SemiImplicit::Memory& like) {
  check_size("a rate", memory.rate.size(), like.rate.size());
  check_size("an increment", memory.increment.size(), like.increment.size());
  check_size("an increment", memory.nodal_increment.size(), like.nodal_increment.size());
  check_size("the list of responses", memory.responses.size(), like.responses.size());
  for (std::size_t i = 0; i < memory.responses.size(); i++) {
    check_size("a response", memory.responses[i].modes.size(), like.responses[i].modes.size());
    check_size("a response", memory.responses[i].nodal.size(), like.responses[i].nodal.size());
  }
}

/// Each has its share of what is held, and a node at least.
void check_vesicles(const Vesicle::State& s, const Grid& grid) {
  const std::size_t numbers = s.constraints.share.size();
  const int count = int(numbers / 4);
  if (count == 0 || numbers % 4 != 0) refuse("the number of vesicles");
  check_size("the list of groups", s.constraints.group.size(), std::size_t(count));
  check_size("the list of vesicles", s.vesicle_of_node.size(), count == 1 ? 0 : grid.size());
  if (count == 1) return;
  const auto [low, high] = std::ranges::minmax(s.vesicle_of_node);
  if (low < -1 || high != count - 1) refuse("the number of vesicles");
}

void check_fits(const SimulationState& s, const Scene& scene) {
  const Grid grid = scene.grid();
  check_size("phi", s.vesicle.phi.size(), grid.size());
  for (const std::string& name : scene.evolving_fields()) {
    if (!s.vesicle.fields.contains(name)) refuse(name + " is missing");
    check_size(name, s.vesicle.fields.at(name).coefficients.size(), grid.size());
  }
  check_size("the list of fields", s.vesicle.fields.size(), scene.evolving_fields().size());
  if (scene.has_phases() != s.measures.phases.has_value()) refuse("the number of phases");
  if ((scene.stretch.modulus > 0) != s.measures.stretch.has_value()) refuse("the stretch modulus");
  if (s.steps < 1) refuse("it has made no step");
  check_vesicles(s.vesicle, grid);
  if (s.excess.empty() || s.excess.size() % 4 != 0) refuse("the number of vesicles");
  check_fits(s.vesicle.band, grid);
}

const SimulationState& fitting(const SimulationState& s, const Scene& scene) {
  check_fits(s, scene);
  return s;
}

void restore(SemiImplicit& stepper, const SemiImplicit::Memory& from) {
  check_fits(from, stepper.memory());
  stepper.remember(from);
}

} // namespace

Simulation::Simulation(const Scene& scene, const SimulationState& s, const SurfaceTerms& more)
    : contact_(scene.contact), control_(control_of(scene)), fourier_(scene.grid()),
      vesicle_(scene, fitting(s, scene).vesicle, s.measures.time, fourier_, more),
      gauge_(scene.grid()), stepper_(scene.grid(), fourier_, responses_of(scene)),
      inside_(s.inside), outside_(s.outside), why_not_on_(s.why_not_on),
      excess_(Eigen::Map<const Quantities>(s.excess.data(), 4, Eigen::Index(s.excess.size() / 4))),
      error_(s.error), last_dt_(s.last_dt), response_dt_(s.response_dt),
      history_share_(s.history_share), steps_(s.steps), renormalised_(s.renormalised),
      next_parting_(s.next_parting), next_search_(s.next_search), failures_(s.failures),
      failed_before_(s.failed_before), driven_(s.driven), cells_(s.cells), topology_(s.topology),
      domains_(s.domains), measures_(s.measures), events_(s.events) {
  const auto name = [](const auto& term) { return term.first; };
  if (!std::ranges::equal(vesicle_.energies().others(), measures_.terms.others(), {}, name, name))
    refuse("the terms of the energy that are not built in");
  restore(stepper_, s.stepper);
  for (EvolvingField* field : vesicle_.fields())
    if (const auto from = s.field_steppers.find(field->name()); from != s.field_steppers.end())
      restore(field->stepper(), from->second);
}

SimulationState Simulation::state() const {
  SimulationState s{.measures = measures_,
                    .events = events_,
                    .vesicle = vesicle_.state(),
                    .stepper = stepper_.memory(),
                    .field_steppers = {},
                    .excess = {excess_.data(), excess_.data() + excess_.size()},
                    .error = error_,
                    .last_dt = last_dt_,
                    .response_dt = response_dt_,
                    .history_share = history_share_,
                    .steps = steps_,
                    .renormalised = renormalised_,
                    .next_parting = next_parting_,
                    .next_search = next_search_,
                    .failures = failures_,
                    .failed_before = failed_before_,
                    .driven = driven_,
                    .cells = cells_,
                    .topology = topology_,
                    .domains = domains_,
                    .inside = inside_,
                    .outside = outside_,
                    .why_not_on = why_not_on_};
  for (const EvolvingField* field : vesicle_.fields())
    if (const SemiImplicit* stepper = field->stepper_if_made())
      s.field_steppers[field->name()] = stepper->memory();
  for (auto* places : {&s.inside, &s.outside})
    for (CriticalPoint& place : *places) place.around.clear();
  return s;
}

} // namespace lamella
