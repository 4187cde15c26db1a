#pragma once
#include <functional>

namespace lamella {

/// What the command line asks for, as a call that does it and returns an ExitCode. Throws
/// UsageError, with one line that says what would be right.
std::function<int()> parse_command_line(int argc, const char* const* argv);

} // namespace lamella
