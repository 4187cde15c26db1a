#pragma once
#include "store/folder.h"

#include <cstddef>
#include <span>
#include <string_view>

namespace lamella {

/// Write a file that appears whole or not at all, also when the machine stops in between: a
/// temporary file in the same folder is written, synchronised and renamed. Replaces what was there,
/// if that is a regular file. Throws StoreError with the system's words, and leaves no temporary
/// file behind.
void write_atomically(const Place& place, std::span<const std::byte> content);
void write_atomically(const std::filesystem::path& file, std::span<const std::byte> content);
void write_text_atomically(const Place& place, std::string_view text);
void write_text_atomically(const std::filesystem::path& file, std::string_view text);

} // namespace lamella
