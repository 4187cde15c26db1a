#include "regular_file.h"

#include "error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace lamella {

namespace fs = std::filesystem;

namespace {

std::string words_for(int error) { return std::generic_category().message(error); }

/// What is there, in words; empty for a regular file.
std::string other_kind(mode_t mode) {
  if (S_ISREG(mode)) return {};
  if (S_ISDIR(mode)) return "it is a folder";
  if (S_ISFIFO(mode)) return "it is a pipe, not a file";
  if (S_ISSOCK(mode)) return "it is a socket, not a file";
  return "it is a device, not a file";
}

/// Why a name cannot be looked up.
std::string why_missing(const fs::path& file, int error) {
  return error == ENOENT && !is_free(file) ? "it is a symbolic link to something that is not there"
                                           : words_for(error);
}

} // namespace

RegularFile::RegularFile(const fs::path& file) : path_(file), descriptor_(-1) {
  struct stat there {};
  if (::stat(file.c_str(), &there) != 0) refuse(why_missing(file, errno));
  if (const std::string kind = other_kind(there.st_mode); !kind.empty()) refuse(kind);
  descriptor_ = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (descriptor_ < 0) refuse(words_for(errno));
  if (::fstat(descriptor_, &there) != 0 || !S_ISREG(there.st_mode)) { // exchanged in between
    ::close(descriptor_);
    refuse("it is not a file any more");
  }
  size_ = std::uintmax_t(there.st_size);
}

RegularFile::~RegularFile() { ::close(descriptor_); }

void RegularFile::refuse(const std::string& why) const {
  throw StoreError(fmt::format("{}: cannot be read: {}", path_.string(), why));
}

std::size_t RegularFile::read_some(std::uintmax_t from, std::span<std::byte> bytes) const {
  ssize_t count = 0;
  do count = ::pread(descriptor_, bytes.data(), bytes.size(), off_t(from));
  while (count < 0 && errno == EINTR);
  if (count < 0) refuse(words_for(errno));
  return std::size_t(count);
}

void RegularFile::read(std::uintmax_t from, std::span<std::byte> bytes) const {
  while (!bytes.empty()) {
    const std::size_t count = read_some(from, bytes);
    if (count == 0) refuse("it ends too early");
    from += count;
    bytes = bytes.subspan(count);
  }
}

std::string RegularFile::text(std::size_t most) const {
  constexpr std::size_t portion = 1 << 16; // files in /proc do not tell their size
  std::string text;
  for (std::size_t count = 1; count > 0 && text.size() < most;) {
    const std::size_t before = text.size();
    text.resize(
        std::min(most, before + std::max<std::size_t>(portion, size_ - std::min(size_, before))));
    count = read_some(before, std::as_writable_bytes(std::span(text).subspan(before)));
    text.resize(before + count);
  }
  return text;
}

std::string file_text(const fs::path& file, std::size_t most) {
  return RegularFile(file).text(most);
}

bool is_free(const fs::path& name) {
  std::error_code ignored;
  return fs::symlink_status(name, ignored).type() == fs::file_type::not_found;
}

} // namespace lamella
