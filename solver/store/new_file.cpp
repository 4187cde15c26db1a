#include "store/new_file.h"

#include "error.h"

#include <fmt/format.h>

#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace lamella {

namespace {

std::string temporary_name(const std::string& name) {
  static std::atomic<unsigned> count = 0;
  return fmt::format(".{}.{}-{}.tmp", name, ::getpid(), count++);
}

} // namespace

void throw_system_error(const std::filesystem::path& file, std::string_view what) {
  throw StoreError(fmt::format("{}: cannot be {}: {}", file.string(), what,
                               std::generic_category().message(errno)));
}

NewFile::NewFile(const Place& place) : place_(place) {
  place.refuse_other_kinds();
  do { // a program that was killed may have left a name
    temporary_ = temporary_name(place.name);
    descriptor_ = ::openat(place.folder.descriptor(), temporary_.c_str(),
                           O_CREAT | O_EXCL | O_WRONLY | O_APPEND | O_CLOEXEC, 0666);
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ < 0) throw_system_error(place.path(), "created");
}

NewFile::NewFile(NewFile&& other) noexcept
    : place_(std::move(other.place_)), temporary_(std::exchange(other.temporary_, {})),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

NewFile::~NewFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlinkat(place_.folder.descriptor(), temporary_.c_str(), 0);
}

void NewFile::write(std::span<const std::byte> content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor_, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw_system_error(place_.path(), "written");
    content = content.subspan(static_cast<std::size_t>(written));
  }
}

void NewFile::synchronise() {
  if (::fsync(descriptor_) == 0) return;
  if (errno != EINVAL && errno != ENOSYS && errno != ENOTSUP)
    throw_system_error(place_.path(), "written to the disk");
}

bool NewFile::truncate(std::size_t size) noexcept {
  return ::ftruncate(descriptor_, static_cast<off_t>(size)) == 0;
}

void NewFile::put_in_place() {
  place_.folder.rename(temporary_, place_.name);
  temporary_.clear();
}

} // namespace lamella
