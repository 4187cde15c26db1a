#pragma once
#include "expression/functions.h"

#include <ginac/ginac.h>

#include <span>
#include <string_view>

namespace lamella {

/// A function that texts of formulas name. Only sources of this folder include this.
struct KnownFunction {
  std::string_view name;
  Function function;
  GiNaC::ex (*symbolic)(const GiNaC::ex&);
};

std::span<const KnownFunction> known_functions();

} // namespace lamella
