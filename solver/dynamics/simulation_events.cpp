#include "dynamics/simulation.h"

#include "error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

// What happens to a membrane besides moving: it parts, ruptures, meets itself, comes near the sides
// of the box, or becomes finer than the grid.
namespace lamella {

namespace {
// Spacings. Of the membrane from a side of the box, at which the box follows it.
constexpr double recentre_margin = 3.5;
// Smaller radii of curvature and half-widths of gaps are reported as unresolved.
constexpr double least_radius = 0.76, least_half_gap = 0.8;

constexpr double worst_parted_drift = 1e-4; // of the constraints, after parting
constexpr int most_cuts = 16;               // at one time
constexpr int steps_between_attempts = 5;   // to part where it would have raised the energy
// Squared spacings: smaller domains do not count; smaller ones that are gone shrank away.
constexpr double least_domain = 8, vanishing_domain = 40;
constexpr double restart_step = 0.03; // after parting; h^4 / kappa

double distance(const Domain& a, const Domain& b) {
  return std::hypot(a.center[0] - b.center[0], a.center[1] - b.center[1],
                    a.center[2] - b.center[2]);
}

/// The domain that has no counterpart among the others, and the one of them that is nearest to it,
/// if any.
std::pair<const Domain*, const Domain*> odd_one(std::span<const Domain> domains,
                                                std::span<const Domain> others) {
  std::pair<const Domain*, const Domain*> odd{};
  double farthest = -1;
  for (const Domain& d : domains) {
    const Domain* nearest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const Domain& o : others)
      if (const double far = distance(d, o); far < least) {
        least = far;
        nearest = &o;
      }
    if (least > farthest) {
      farthest = least;
      odd = {&d, nearest};
    }
  }
  return odd;
}

/// Where a domain, were it round, ends towards another.
Vec3 rim(const Domain& domain, const Domain& other) {
  const double radius = std::sqrt(domain.area / std::numbers::pi),
               share = std::min(1.0, radius / distance(domain, other));
  Vec3 x;
  for (int d = 0; d < 3; d++) x[d] = std::lerp(domain.center[d], other.center[d], share);
  return x;
}
} // namespace

Vec3 Simulation::in_space(Vec3 place) const {
  for (int d = 0; d < 3; d++) place[d] += cells_[d] * grid().spacing;
  return place;
}

/// Of the state that the membrane is in.
void Simulation::note(const Measures& measures) {
  measures_ = measures;
  of_vesicles_.clear();
  if (vesicles() > 1) of_vesicles_ = measured_vesicles();
}

std::vector<ComponentMeasures> Simulation::measured_vesicles() const {
  std::vector<ComponentMeasures> all = vesicle_.component_measures(time());
  for (ComponentMeasures& m : all) m.center = in_space(m.center);
  return all;
}

void Simulation::note(Event event) {
  event.time = time();
  event.place = in_space(event.place);
  events_.push_back(event);
}

/// With what there is now, before and after.
Event Simulation::event_now() const {
  Event e;
  e.components_before = e.components_after = measures_.components;
  e.genus_before = e.genus_after = measures_.genus;
  if (measures_.phases) e.domains_before = e.domains_after = measures_.phases->domains_Ld;
  e.area_before = e.area_cut = measures_.area;
  e.energy_before = e.energy_after = measures_.energy;
  return e;
}

/// The Ld domains that are more than a speck of a few nodes.
std::vector<Domain> Simulation::domains() const {
  const double least = least_domain * grid().spacing * grid().spacing;
  std::vector<Domain> found;
  if (vesicle_.phases())
    for (const Domain& d : vesicle_.phases()->domains())
      if (d.is_Ld && d.area > least) found.push_back(d);
  return found;
}

/// Notes that Ld domains met, parted or shrank away: where one is gone that was only a few spacings
/// across, it shrank.
void Simulation::note_domains() {
  const std::vector<Domain> before = std::exchange(domains_, domains());
  if (before.size() == domains_.size()) return;
  const bool fewer = domains_.size() < before.size();
  const std::vector<Domain>&more = fewer ? before : domains_, &others = fewer ? domains_ : before;
  const double h = grid().spacing;
  Event e = event_now();
  e.domains_before = int(before.size());
  e.domains_after = int(domains_.size());
  const auto [odd, nearest] = odd_one(more, others);
  const bool vanished = fewer && odd->area < vanishing_domain * h * h;
  e.kind = vanished ? Event::Kind::domain_vanished
           : fewer  ? Event::Kind::domains_merged
                    : Event::Kind::domain_parted;
  e.place = vanished || !nearest ? odd->center : rim(*odd, *nearest);
  note(e);
}

/// Says once of each kind that something has become finer than the grid.
void Simulation::note_unresolved() {
  const SurfaceGeometry& surface = vesicle_.surface();
  auto noted = [&](Event::Kind kind) {
    return std::ranges::any_of(events_, [&](const Event& e) { return e.kind == kind; });
  };
  if (!noted(Event::Kind::sharp)) {
    std::size_t worst = 0;
    double sharpest = 0;
    for (std::size_t i = 0; i < surface.size(); i++)
      if (surface.weight()[i] > 0 && surface.sharpest(i) > sharpest)
        sharpest = surface.sharpest(worst = i);
    if (sharpest * least_radius * grid().spacing > 1) {
      Event e = event_now();
      e.kind = Event::Kind::sharp;
      e.place = surface.point(worst);
      e.size = 1 / sharpest;
      note(e);
    }
  }
  const double least = least_half_gap * grid().spacing;
  for (auto [kind, places] :
       {std::pair{Event::Kind::thin_inside, &inside_}, {Event::Kind::thin_outside, &outside_}}) {
    if (noted(kind) || places->empty() || places->front().radius > least) continue;
    Event e = event_now();
    e.kind = kind;
    e.place = places->front().place;
    e.size = places->front().radius;
    note(e);
  }
}

/// The critical points near the membrane, on either side, the nearest first.
void Simulation::find_narrow_places() {
  const double h = grid().spacing;
  const ClosingRule rule{vesicle_.stiffness_of_grid(), contact_.rupture_thickness};
  const std::vector<double> grad = vesicle_.grad_of_entries();
  inside_ = critical_points(vesicle_.phi(), vesicle_.band(), grad, rule.reach(h), true);
  outside_ = critical_points(vesicle_.phi(), vesicle_.band(), grad, rule.reach(h), false);
}

/// Those inside where the membrane is closing in and the grid can no longer resolve it.
std::optional<Closing> Simulation::closing_place() const {
  const SurfaceGeometry& surface = vesicle_.surface();
  const double h = grid().spacing;
  const ClosingRule rule{vesicle_.stiffness_of_grid(), contact_.rupture_thickness};
  for (const CriticalPoint& q : inside_) {
    double speed = 0, grad = 0;
    int count = 0;
    for (const int s : q.around) {
      const auto at = std::ranges::lower_bound(surface.entry(), s);
      if (at == surface.entry().end() || *at != s) continue;
      const std::size_t i = std::size_t(at - surface.entry().begin());
      speed -= vesicle_.velocity(i);
      grad += surface.grad()[i];
      count++;
    }
    Event::Kind kind{};
    if (count > 0 && rule.parts(q, speed / count, h, kind)) return Closing{kind, q, grad / count};
  }
  return {};
}

/// Notes what parted or met by itself, and parts the inside where it is about to part and that
/// lowers the energy.
void Simulation::change_topology_if_needed() {
  if (topology_ != Topology{measures_.components, measures_.genus}) note_spontaneous_change();
  if (steps_ < next_search_) return;
  find_narrow_places();
  next_search_ = steps_ + steps_until_narrow();
  if (steps_ < next_parting_) return;
  for (int cuts = 0; cuts < most_cuts; cuts++) {
    const std::optional<Closing> place = closing_place();
    if (!place) return;
    if (!contact_.topology_changes) {
      why_not_on_ = fmt::format("the topology is about to change at {}, which "
                                "contact.topology_changes forbids",
                                place_text(in_space(place->at.place), grid().spacing));
      return;
    }
    const bool parted = part_at(*place);
    if (!parted) next_parting_ = steps_ + steps_between_attempts;
    if (!parted || place->kind == Event::Kind::rupture) return;
    find_narrow_places();
  }
}

/// How many steps the nearest of what was found, or the next there may be, takes at least to become
/// narrow enough to part: a step moves the membrane by a quarter of a spacing at most.
long Simulation::steps_until_narrow() const {
  const double h = grid().spacing;
  const ClosingRule rule{vesicle_.stiffness_of_grid(), contact_.rupture_thickness};
  double nearest = rule.reach(h);
  for (const auto* places : {&inside_, &outside_})
    if (!places->empty()) nearest = std::min(nearest, places->front().radius);
  return std::max(1L, long((nearest - rule.least_reach(h)) / (0.25 * h)));
}

/// The place where sheets are nearest: through the outside, a gap, or through the inside.
std::pair<bool, const CriticalPoint*> Simulation::narrowest_place() const {
  const bool gap =
      !outside_.empty() && (inside_.empty() || outside_.front().radius < inside_.front().radius);
  const std::vector<CriticalPoint>& places = gap ? outside_ : inside_;
  return {gap, places.empty() ? nullptr : &places.front()};
}

/// The step that led to `m` broke a film: a hole has opened, and not because a gap closed. What is
/// left of a film that breaks below the grid's resolution means nothing.
bool Simulation::broke_film(const Measures& m) const {
  return m.genus > topology_.genus && !narrowest_place().first;
}

/// A change of topology that a step made. Necks and gaps may close by themselves.
void Simulation::note_spontaneous_change() {
  Event event = event_now();
  event.components_before = topology_.components;
  event.genus_before = topology_.genus;
  topology_ = {measures_.components, measures_.genus};
  const auto [gap, place] = narrowest_place();
  event.place = place ? place->place : place_of_change();
  event.size = place ? place->radius : 0;
  event.kind = gap                                                ? Event::Kind::fusion
               : event.components_after > event.components_before ? Event::Kind::fission
                                                                  : Event::Kind::vanished;
  note(event);
}

/// Of the nodes that came to be on the other side of the membrane in the last step, the one where
/// phi changed most. (Nothing narrow was seen before.)
Vec3 Simulation::place_of_change() const {
  std::vector<double> before(grid().size());
  nodal_values(grid(), stepper_.before(), before);
  const std::span<const double> now = vesicle_.phi().nodal();
  std::size_t most = 0;
  double change = -1;
  for (std::size_t n = 0; n < now.size(); n++) {
    const bool crossed = (now[n] < 0) != (before[n] < 0);
    if (!crossed || std::abs(now[n] - before[n]) <= change) continue;
    change = std::abs(now[n] - before[n]);
    most = n;
  }
  return grid().position(most);
}

std::string Simulation::film_message(const Vec3& place) const {
  return fmt::format("a film of inner fluid at {} has become thinner than the grid resolves; try "
                     "more grid.nodes, or keep films apart with contact.disjoining_pressure",
                     place_text(in_space(place), grid().spacing));
}

/// False, and nothing is changed, where the energy would rise. A neck too thin for the grid parts
/// all the same; a film that thin is the end of the run.
bool Simulation::part_at(const Closing& place) {
  Event event = event_now();
  event.kind = place.kind;
  event.place = place.at.place;
  event.size = place.at.radius;
  const Array<double> whole(vesicle_.phi().coefficients().begin(),
                            vesicle_.phi().coefficients().end());
  const Vesicle::Holdings holdings = vesicle_.holdings();
  auto whole_again = [&] {
    std::ranges::copy(whole, vesicle_.phi().coefficients().begin());
    vesicle_.restore(holdings);
    restart();
    return false;
  };
  part(vesicle_.phi(), place);
  Measures parted;
  try {
    event.area_cut = restart();
    parted = vesicle_.measures(time());
    check(parted);
  } catch (const RunError& e) { // nothing is left, or nothing that could go on
    why_not_on_ = e.what();
    return whole_again();
  }
  const bool film = place.kind == Event::Kind::rupture;
  const bool hopeless =
      event.size <
      (film ? ClosingRule::hopeless_film : ClosingRule::hopeless_neck) * grid().spacing;
  if (!(vesicle_.drift(time()) < worst_parted_drift) ||
      (parted.energy > measures_.energy && (film || !hopeless))) {
    if (film && hopeless) why_not_on_ = film_message(event.place);
    return whole_again();
  }
  const double h = grid().spacing;
  last_dt_ = std::min(last_dt_, restart_step * h * h * h * h / vesicle_.stiffness_of_grid());
  parted.dt = measures_.dt;
  parted.balance = measures_.balance; // of the step that led here
  parted.energy_rise = measures_.energy_rise;
  note(parted);
  event.components_after = measures_.components;
  event.genus_after = measures_.genus;
  event.energy_after = measures_.energy;
  topology_ = {measures_.components, measures_.genus};
  note(event);
  return true;
}

/// Moves the box by whole cells when the membrane comes near one of its sides and has room on the
/// other.
void Simulation::recentre_if_needed() {
  const SurfaceGeometry& surface = vesicle_.surface();
  const double h = grid().spacing;
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (std::size_t i = 0; i < surface.size(); i++) {
    const Vec3 p = surface.point(i);
    for (int d = 0; d < 3; d++) {
      low[d] = std::min(low[d], p[d]);
      high[d] = std::max(high[d], p[d]);
    }
  }
  std::array<int, 3> cells{};
  bool near = false;
  for (int d = 0; d < 3; d++) {
    const double side = 0.5 * grid().length(d);
    near = near || std::min(low[d] + side, side - high[d]) < recentre_margin * h;
    cells[d] = int(std::lround(0.5 * (low[d] + high[d]) / h));
  }
  if (!near || cells == std::array<int, 3>{}) return;
  move_box(cells);
  Event event = event_now();
  event.kind = Event::Kind::recentred;
  event.cells = cells;
  note(event);
}

void Simulation::move_box(const std::array<int, 3>& cells) {
  vesicle_.shift(cells);
  stepper_.shift(cells);
  for (int d = 0; d < 3; d++) {
    cells_[d] += cells[d];
    for (Domain& domain : domains_) domain.center[d] -= cells[d] * grid().spacing;
  }
  vesicle_.measure_anew(time());
}

} // namespace lamella
