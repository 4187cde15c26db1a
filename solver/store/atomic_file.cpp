#include "store/atomic_file.h"

#include "error.h"
#include "store/posix_file.h"

#include <fmt/format.h>

#include <atomic>
#include <cstdio>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace lamella {
namespace {

/// A file name in the folder of `file` that no other writer uses.
std::filesystem::path temporary_name(const std::filesystem::path& file) {
  static std::atomic<unsigned> count = 0;
  return file.parent_path() /
         fmt::format(".{}.{}-{}.tmp", file.filename().string(), ::getpid(), count++);
}

/// Make a rename last through a power failure. Some file systems cannot; the file is whole all the
/// same.
void synchronise_folder(const std::filesystem::path& file) {
  const auto folder = file.parent_path();
  const int descriptor =
      ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

} // namespace

void write_atomically(const std::filesystem::path& file, std::span<const std::byte> content) {
  std::error_code ignored;
  const auto status = std::filesystem::status(file, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw StoreError(
        fmt::format("{}: cannot be replaced: it is not a regular file", file.string()));

  const auto temporary = temporary_name(file);
  PosixFile out(temporary, O_CREAT | O_EXCL);
  try {
    out.write(content);
    out.synchronise();
    out.close();
    if (std::rename(temporary.c_str(), file.c_str()) != 0) throw_system_error(file, "created");
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
  synchronise_folder(file);
}

void write_text_atomically(const std::filesystem::path& file, std::string_view text) {
  write_atomically(file, std::as_bytes(std::span(text)));
}

} // namespace lamella
