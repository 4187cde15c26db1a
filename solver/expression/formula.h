#pragma once
#include "expression/tape.h"

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace lamella {

/// What the text of a formula may speak of, besides functions and pi.
struct FormulaNames {
  std::vector<std::string> variables;    ///< in the order in which a tape takes them; at least one
  std::map<std::string, double> numbers; ///< finite
};

/// A formula as it was read.
struct Formula {
  Tape tape;
  std::set<std::string> names; ///< the variables and numbers that its text speaks of
  /// The variables that each result depends on, as far as its simplified form tells.
  std::vector<std::set<std::string>> dependences;
};

/// The variables by which a formula is differentiated, one after the other; none: its value.
using DifferentiatedBy = std::vector<std::string>;

/// Read a formula such as "a*(KM - C0)^2 + tanh(K)" into a tape that computes `results`, with what
/// they have in common computed once. Multiplication is written, ^ is the power and binds to the
/// right, exponents are numbers; docs/scene-format.md has the functions. Throws FormulaError, with
/// the line and column at fault, for what is not a formula of these names whose coefficients are
/// finite and real, and for a text of more than 2000 characters, 100 brackets or degree 64.
Formula read_formula(std::string_view text, const FormulaNames& names,
                     const std::vector<DifferentiatedBy>& results = {{}});

/// Whether a number may have this name: letters, digits and _, a letter first; none that formulas
/// use for a function or for pi.
bool is_free_name(std::string_view name);

} // namespace lamella
