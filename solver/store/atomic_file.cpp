#include "store/atomic_file.h"

#include "store/new_file.h"

namespace lamella {

void write_atomically(const Place& place, std::span<const std::byte> content) {
  NewFile file(place);
  file.write(content);
  file.synchronise();
  file.put_in_place();
  place.folder.synchronise();
}

void write_atomically(const std::filesystem::path& file, std::span<const std::byte> content) {
  write_atomically(Place(file), content);
}

void write_text_atomically(const Place& place, std::string_view text) {
  write_atomically(place, std::as_bytes(std::span(text)));
}

void write_text_atomically(const std::filesystem::path& file, std::string_view text) {
  write_text_atomically(Place(file), text);
}

} // namespace lamella
