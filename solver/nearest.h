#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lamella {

/// The candidate that a mistyped word most likely meant: least edits (insert, delete, replace, swap
/// neighbours; upper and lower case alike). Nothing if even that one differs in more than a third
/// of the word.
std::optional<std::string_view> nearest(std::string_view word,
                                        std::span<const std::string_view> candidates);

/// `; did you mean "x"?`, or nothing where nothing is near.
std::string suggestion(std::string_view word, std::span<const std::string_view> candidates);

} // namespace lamella
