#include "store/posix_file.h"

#include "error.h"

#include <fmt/format.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace lamella {

void throw_system_error(const std::filesystem::path& file, std::string_view what) {
  throw StoreError(fmt::format("{}: cannot be {}: {}", file.string(), what,
                               std::generic_category().message(errno)));
}

PosixFile::PosixFile(const std::filesystem::path& file, int flags)
    : file_(file), descriptor_(::open(file.c_str(), flags | O_WRONLY | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) throw_system_error(file_, "created");
}

PosixFile::PosixFile(PosixFile&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

PosixFile::~PosixFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void PosixFile::write(std::span<const std::byte> content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor_, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw_system_error(file_, "written");
    content = content.subspan(static_cast<std::size_t>(written));
  }
}

void PosixFile::synchronise() {
  if (::fsync(descriptor_) != 0) throw_system_error(file_, "written to the disk");
}

bool PosixFile::truncate(std::size_t size) noexcept {
  return ::ftruncate(descriptor_, static_cast<off_t>(size)) == 0;
}

void PosixFile::close() {
  if (::close(std::exchange(descriptor_, -1)) != 0) throw_system_error(file_, "written");
}

} // namespace lamella
