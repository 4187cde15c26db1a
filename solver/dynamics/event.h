#pragma once
#include "grid/grid.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace lamella {

/// Something that happened to a membrane and that its numbers alone do not tell.
struct Event {
  enum class Kind {
    fission,         ///< a neck was cut, or closed by itself
    rupture,         ///< a film of inner fluid broke: a hole through the vesicle
    fusion,          ///< two places of the membrane met and became one
    vanished,        ///< a part too small for the grid was removed
    recentred,       ///< the box followed the vesicle
    domains_merged,  ///< two domains of the Ld phase met and became one
    domain_parted,   ///< one became two
    domain_vanished, ///< one shrank away
    sharp,           ///< a radius of curvature is below what the grid resolves
    thin_inside, ///< the membrane is nearer to itself, through the inside, than the grid resolves
    thin_outside ///< the same through the outside
  };
  Kind kind = Kind::fission;
  double time = 0;
  Vec3 place{};    ///< where ParaView shows it: the cells by which the box has moved are added
  double size = 0; ///< length: neck radius, half the thickness of a film or gap, radius of
                   ///< curvature; 0: not known
  int components_before = 0, components_after = 0;
  int genus_before = 0, genus_after = 0;
  int domains_before = 0, domains_after = 0;  ///< of the Ld phase
  double area_before = 0, area_cut = 0;       ///< as the change of topology left it; then put back
  double energy_before = 0, energy_after = 0; ///< after: on the constraints again
  std::array<int, 3> cells{};                 ///< recentred: the box moved by so many

  bool changes_topology() const { return kind <= Kind::vanished; }
  bool is_under_resolved() const { return kind >= Kind::sharp; }
  bool operator==(const Event&) const = default;
};

/// "fission", "thin_inside"
std::string_view to_string(Event::Kind kind);
/// The other way round; nothing for another word.
std::optional<Event::Kind> event_kind(std::string_view word);

/// "(0.1, 0.2, 0)": coordinates to the decimal that is a tenth of a grid spacing or less, without a
/// minus before zero.
std::string place_text(const Vec3& place, double spacing);
/// Where there is no grid: to a few digits of the largest coordinate.
std::string place_text(const Vec3& place);

/// One line for a person, on a grid of the given spacing: "t = 0.000251: a neck was cut at (0.1,
/// 0.2, 0): components 1 -> 2, ..."
std::string to_text(const Event& event, double spacing);

} // namespace lamella
