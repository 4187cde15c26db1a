#pragma once
#include "scene/keys.h"

#include <string>
#include <string_view>

namespace lamella {

/// area_difference: AreaDifference.
inline std::string camel(std::string_view name) {
  std::string out;
  bool upper = true;
  for (const char c : name) {
    if (c != '_') out += upper ? char(std::toupper(c)) : c;
    upper = c == '_';
  }
  return out;
}

/// The property of a proxy that stands for a parameter; one for the targets of a ramp and their
/// start times.
inline std::string property_name(const Key& key) {
  const bool bare = key.section == "grid" || key.section == "membrane" || key.section == "run" ||
                    key.section == "numerics";
  return (bare ? "" : camel(key.section)) + camel(key.name);
}

} // namespace lamella
