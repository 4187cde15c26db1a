#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace lamella {

/// Throw a StoreError "file: cannot be <what>: <the system's words for errno>".
[[noreturn]] void throw_system_error(const std::filesystem::path& file, std::string_view what);

/// An open file for writing. Every failure throws StoreError.
class PosixFile {
public:
  /// flags: those of open(2), O_WRONLY | O_CLOEXEC is added.
  PosixFile(const std::filesystem::path& file, int flags);
  ~PosixFile();
  PosixFile(PosixFile&& other) noexcept;
  PosixFile& operator=(PosixFile&&) = delete;

  void write(std::span<const std::byte> content);
  void synchronise();
  /// Cut the file to a size; false if that is impossible.
  bool truncate(std::size_t size) noexcept;
  /// Close and report what the system only says then.
  void close();

private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

} // namespace lamella
