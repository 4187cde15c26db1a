#pragma once
#include <filesystem>
#include <string>

namespace lamella {

/// A path as a word of a command that a user can paste into a shell.
std::string shell_word(const std::filesystem::path& path);

} // namespace lamella
