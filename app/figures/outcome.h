#pragma once
#include "figures/figure_spec.h"
#include "render/surface.h"

namespace lamella {

/// A number that tells what has become of a membrane: a column of history.csv, such as components,
/// genus or domains_Ld, or
///   arms   seen along z, what sticks out, by 4 % of the largest radius at least
///   beads  along z, what is thicker than what lies beside it, by as much
///   buds   Ld domains with twice or more the area of a flat one inside their boundary
/// Nothing for another name, or where the run does not have the column.
std::optional<double> outcome_of(const render::State& state, const std::string& name);

/// What is not as expected: "components is 3, expected 4". Empty where all is.
std::vector<std::string> surprises(const render::State& state, const Expectations& expect);

} // namespace lamella
