#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace lamella {

/// A file to read from. What is no regular file - a folder, a pipe, a device - is refused without
/// waiting for it. All members throw StoreError, one sentence with the name.
class RegularFile {
public:
  explicit RegularFile(const std::filesystem::path& file);
  ~RegularFile();
  RegularFile(const RegularFile&) = delete;
  RegularFile& operator=(const RegularFile&) = delete;

  std::uintmax_t size() const { return size_; }
  /// All of `bytes`, from a place in the file on.
  void read(std::uintmax_t from, std::span<std::byte> bytes) const;
  /// The whole file, but no more than so many bytes of it.
  std::string text(std::size_t most) const;

private:
  std::size_t read_some(std::uintmax_t from, std::span<std::byte> bytes) const;
  [[noreturn]] void refuse(const std::string& why) const;

  std::filesystem::path path_;
  int descriptor_;
  std::uintmax_t size_ = 0;
};

/// The whole of a file, of at most so many bytes. Throws StoreError.
std::string file_text(const std::filesystem::path& file, std::size_t most = std::size_t(1) << 32);

/// Whether a name stands for nothing at all; a symbolic link to nothing is something.
bool is_free(const std::filesystem::path& name);

} // namespace lamella
