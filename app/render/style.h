#pragma once
#include "energy/energy_terms.h"
#include "render/picture.h"

#include <array>

/// The look that all pictures share; lengths in units of a page that is 2100 units wide.
namespace lamella::render::style {

constexpr double page_width = 2100;

constexpr Color ink{38, 38, 42};
constexpr Color faint_ink{150, 150, 156};

/// A colour of lit membranes, and the same hue dark enough for lines on white.
struct Hue {
  Color surface, line;
};
/// Coral, as for liquid-disordered lipid in stained vesicles.
constexpr Hue membrane{{236, 122, 100}, {190, 62, 44}};
/// Of two phases. They differ in lightness too, and in no eye look alike.
constexpr Hue Ld{{226, 92, 80}, {190, 62, 44}}, Lo{{96, 152, 214}, {38, 98, 168}};

/// Of curves on white, no two alike.
constexpr Color ochre{176, 122, 0}, teal{0, 128, 108}, violet{130, 90, 160}, sky{70, 170, 215},
    pink{222, 92, 150}, brown{110, 58, 20}, olive{132, 140, 20}, navy{40, 44, 120},
    plum{140, 20, 90}, lime{110, 185, 60}, peach{236, 150, 90}, slate{112, 124, 140},
    moss{70, 100, 50}, maroon{110, 25, 35};
inline constexpr std::array curves{membrane.line, Lo.line, teal, ochre, violet, sky, pink, brown};

/// Of the energy of the phase boundary.
constexpr Color line_energy = ochre;
/// Of terms that are not built in.
constexpr Color other_term = faint_ink;
/// Of a term that lives elsewhere.
constexpr Color of_term(Term term) {
  switch (term) {
  case Term::gaussian:
    return teal;
  case Term::linear:
    return olive;
  case Term::cubic:
    return navy;
  case Term::mixed_cubic:
    return plum;
  case Term::quartic:
    return lime;
  case Term::mixed_quartic:
    return peach;
  case Term::gaussian_square:
    return slate;
  case Term::gradient:
    return maroon;
  case Term::density:
    return moss;
  case Term::stretch:
    return violet;
  case Term::pressure:
    return sky;
  case Term::area_difference:
    return pink;
  case Term::film:
    return brown;
  default:
    return membrane.line;
  }
}

constexpr double type_size = 50; ///< 9 pt at 400 pixels per inch
constexpr double small_type = 44;
constexpr double hairline = 3.5;
constexpr double curve_width = 8;
constexpr double boundary_width = 7; ///< of the line between two phases

} // namespace lamella::render::style
