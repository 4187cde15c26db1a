#pragma once
#include <string>
#include <string_view>

namespace lamella {

/// Of the program: "0.1.0".
std::string_view version();

/// What the last bits of results depend on besides: the kernels that this CPU runs, the transforms.
std::string arithmetic();

} // namespace lamella
