#pragma once
#include "dynamics/measures.h"
#include "store/frame.h"

#include <array>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace lamella {

/// A picture could not be drawn; the message says why and what would help.
struct RenderError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What a run cost and how wrong it was.
struct Trade {
  std::array<int, 3> nodes{};
  double seconds = 0, error = 0; ///< wall time; relative error
  bool on_front = false;         ///< no other one is both faster and more accurate
  std::string name;              ///< of a preset, or nothing
};

} // namespace lamella
