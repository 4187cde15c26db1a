#include "shell_word.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace lamella {

std::string shell_word(const std::filesystem::path& path) {
  const std::string text = path.string().starts_with('-') ? "./" + path.string() : path.string();
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) || c >= 0x80 ||
           std::string_view("_./-+=:@%,").find(char(c)) != std::string_view::npos;
  };
  if (!text.empty() && std::ranges::all_of(text, is_plain)) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

} // namespace lamella
