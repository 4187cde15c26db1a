#pragma once
#include "render/picture.h"

/// The look that all pictures share; lengths in units of a page that is 2100 units wide.
namespace lamella::render::style {

constexpr double page_width = 2100;

constexpr Color ink{38, 38, 42};
constexpr Color faint_ink{150, 150, 156};
constexpr Color membrane{236, 122,
                         100}; ///< coral, as for liquid-disordered lipid in stained vesicles
constexpr Color membrane_line{190, 62, 44}; ///< the same hue, dark enough for lines on white

constexpr double type_size = 50; ///< 9 pt at 400 pixels per inch
constexpr double small_type = 44;
constexpr double hairline = 3.5;
constexpr double curve_width = 8;

} // namespace lamella::render::style
