#pragma once
#include <span>
#include <string_view>

namespace lamella {

/// A table of data/reference, compiled in.
struct BuiltinReference {
  std::string_view scene; ///< built-in, of which it is the exact solution
  std::string_view file;  ///< relaxation_oblate_v0.6.csv
  std::string_view table; ///< the whole file
};

std::span<const BuiltinReference> builtin_references();

} // namespace lamella
