#pragma once
#include "dynamics/measures.h"
#include "extremes/cases.h"
#include "tradeoff/reference.h"

#include <string_view>

namespace lamella {

/// What a case should have come to when its numbers are those of `end`; bending modulus 1, no
/// spontaneous curvature. Numbers that are not known are NaN, all of them where nothing is.
/// Throws std::logic_error for a reduced volume that the tables do not have.
ReferenceState known_answer(const ExtremeCase& which, const Measures& end);

/// Errors up to which an answer is right, relative.
struct AllowedErrors {
  double energy, multipliers;
};
AllowedErrors allowed_errors(Known known);

/// "oblate at rest"
std::string_view to_string(Known known);

} // namespace lamella
