#include "dynamics/event.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace lamella {

namespace {

constexpr std::array<std::string_view, 11> names{
    "fission",       "rupture",         "fusion", "vanished",    "recentred",   "domains_merged",
    "domain_parted", "domain_vanished", "sharp",  "thin_inside", "thin_outside"};

/// A length, and how many grid spacings it is.
std::string length_text(double length, double spacing) {
  return fmt::format("{:.3g} ({:.2g} grid spacings)", length, length / spacing);
}

std::string what_happened(const Event& event, double spacing) {
  const std::string place = place_text(event.place, spacing),
                    radius = length_text(event.size, spacing),
                    of_radius = event.size > 0 ? " of radius " + radius : "",
                    thickness = length_text(2 * event.size, spacing);
  switch (event.kind) {
  case Event::Kind::fission:
    return fmt::format("a neck{} was cut at {}", of_radius, place);
  case Event::Kind::rupture:
    return fmt::format("a film of inner fluid, {} thick, ruptured at {}", thickness, place);
  case Event::Kind::fusion:
    return fmt::format("the membrane fused with itself across a gap of {} at {}", thickness, place);
  case Event::Kind::vanished:
    return fmt::format("a part{} at {}, too small for the grid, was removed", of_radius, place);
  case Event::Kind::recentred:
    return fmt::format("the box moved by ({}) cells to follow the vesicle",
                       fmt::join(event.cells, ", "));
  case Event::Kind::domains_merged:
    return fmt::format("Ld domains met at {} and became one: {} -> {} domains", place,
                       event.domains_before, event.domains_after);
  case Event::Kind::domain_parted:
    return fmt::format("an Ld domain parted at {}: {} -> {} domains", place, event.domains_before,
                       event.domains_after);
  case Event::Kind::domain_vanished:
    return fmt::format("an Ld domain shrank away at {}: {} -> {} domains", place,
                       event.domains_before, event.domains_after);
  case Event::Kind::sharp:
    return fmt::format("the membrane bends with a radius of {} at {}, sharper than the grid "
                       "resolves",
                       radius, place);
  case Event::Kind::thin_inside:
    return fmt::format("the vesicle is {} thick at {}, thinner than the grid resolves", thickness,
                       place);
  case Event::Kind::thin_outside:
    return fmt::format("a gap of {} is left outside the membrane at {}, narrower than the grid "
                       "resolves",
                       thickness, place);
  }
  return {};
}

std::string change_text(const Event& event) {
  return fmt::format("components {} -> {}, genus {} -> {}; area changed by {:.2g} % and restored; "
                     "energy {:.6g} -> {:.6g}",
                     event.components_before, event.components_after, event.genus_before,
                     event.genus_after, 100 * (event.area_cut / event.area_before - 1),
                     event.energy_before, event.energy_after);
}

} // namespace

std::string place_text(const Vec3& place, double spacing) {
  const double digits = std::pow(10., -std::floor(std::log10(spacing / 10)));
  const auto rounded = [=](double x) { return std::round(digits * x) / digits + 0.0; };
  return fmt::format("({:g}, {:g}, {:g})", rounded(place[0]), rounded(place[1]), rounded(place[2]));
}

std::string place_text(const Vec3& place) {
  const auto [x, y, z] = place;
  return place_text(place,
                    std::max({0.05 * std::abs(x), 0.05 * std::abs(y), 0.05 * std::abs(z), 1e-30}));
}

std::string_view to_string(Event::Kind kind) { return names[std::size_t(kind)]; }

std::optional<Event::Kind> event_kind(std::string_view word) {
  const auto name = std::ranges::find(names, word);
  if (name == names.end()) return {};
  return Event::Kind(name - names.begin());
}

std::string to_text(const Event& event, double spacing) {
  std::string text = fmt::format("t = {:.6g}: {}", event.time, what_happened(event, spacing));
  if (event.changes_topology()) text += "; " + change_text(event);
  if (event.is_under_resolved()) text += "; more grid.nodes help";
  return text;
}

} // namespace lamella
