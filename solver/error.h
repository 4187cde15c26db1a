#pragma once
#include <stdexcept>

namespace lamella {

/// The scene asks for something impossible; the message names file, line, key and what is allowed.
struct SceneError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The run cannot go on (non-finite values, collapsed step, shape left the box); says why and at
/// which time.
struct RunError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A text is no formula; the message says where in it and what is allowed.
struct FormulaError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A file could not be written or read; the message names it and what the system said.
struct StoreError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

} // namespace lamella
