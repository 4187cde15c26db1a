#pragma once
#include <stdexcept>

namespace lamella {

/// The command line asks for something impossible; nothing was written.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

} // namespace lamella
