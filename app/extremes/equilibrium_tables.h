#pragma once
#include <string_view>

namespace lamella {

/// single_phase_oblate.csv and single_phase_prolate.csv of data/reference, compiled in: a line of
/// column names, then rows that begin with v, E / (8 pi kappa), int K_M^2 dA, P Rs^3 / kappa and
/// sigma Rs^2 / kappa.
extern const std::string_view oblate_equilibria, prolate_equilibria;

} // namespace lamella
