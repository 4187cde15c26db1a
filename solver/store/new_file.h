#pragma once
#include "store/folder.h"

#include <cstddef>
#include <span>
#include <string_view>

namespace lamella {

/// Throw a StoreError "file: cannot be <what>: <the system's words for errno>".
[[noreturn]] void throw_system_error(const std::filesystem::path& file, std::string_view what);

/// A new file, open for writing. Every failure throws StoreError.
class NewFile {
public:
  /// Under a temporary name in the folder of `place`, which nothing else uses; gone with this
  /// object unless it is put in place.
  explicit NewFile(const Place& place);
  ~NewFile();
  NewFile(NewFile&& other) noexcept;
  NewFile& operator=(NewFile&&) = delete;

  void write(std::span<const std::byte> content);
  /// Makes what was written last through a power failure. Some file systems cannot, and say so.
  void synchronise();
  /// Cut the file to a size; false if that is impossible.
  bool truncate(std::size_t size) noexcept;
  /// Give it its name, in place of what has that name; it stays open.
  void put_in_place();
  /// For others to write to it.
  int descriptor() const { return descriptor_; }

private:
  Place place_;
  std::string temporary_; ///< empty: in place
  int descriptor_ = -1;
};

} // namespace lamella
