#pragma once
#include <string>
#include <string_view>

namespace lamella {

/// Of the program, and what the sources of its solver hash to: "0.1.0+1a2b3c4d".
std::string_view version();

/// What the last bits of results depend on besides: the kernels that this CPU runs, the transforms.
std::string arithmetic();

} // namespace lamella
