#include "store/folder.h"

#include "error.h"
#include "store/new_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <string_view>

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace lamella {

namespace fs = std::filesystem;

namespace {

constexpr int as_folder = O_RDONLY | O_DIRECTORY | O_CLOEXEC;

fs::file_type type_of_mode(mode_t mode) {
  if (S_ISREG(mode)) return fs::file_type::regular;
  if (S_ISDIR(mode)) return fs::file_type::directory;
  if (S_ISLNK(mode)) return fs::file_type::symlink;
  return fs::file_type::unknown;
}

} // namespace

Folder::Folder(fs::path path, int descriptor)
    : path_(std::move(path)), descriptor_(new int(descriptor), [](const int* open) {
        ::close(*open);
        delete open;
      }) {}

Folder::Folder(const fs::path& path)
    : Folder(path, ::open(path.empty() ? "." : path.c_str(), as_folder)) {
  if (descriptor() < 0) throw_system_error(path, "opened");
}

void Folder::refuse(const std::string& name, std::string_view what) const {
  throw_system_error(path_ / name, what);
}

std::optional<Folder> Folder::find(const std::string& name) const {
  const int open = ::openat(descriptor(), name.c_str(), as_folder | O_NOFOLLOW);
  if (open >= 0) return Folder(path_ / name, open);
  const int why = errno;
  if (why == ENOENT) return {};
  if (type_of(name) == fs::file_type::symlink)
    throw StoreError(fmt::format("{}: is a symbolic link, where a folder of the program's own "
                                 "should be; move it away",
                                 (path_ / name).string()));
  errno = why;
  refuse(name, "opened");
}

Folder Folder::inner(const std::string& name) const {
  if (::mkdirat(descriptor(), name.c_str(), 0777) != 0 && errno != EEXIST) refuse(name, "created");
  if (std::optional<Folder> folder = find(name)) return *folder;
  errno = ENOENT;
  refuse(name, "opened");
}

fs::file_type Folder::type_of(const std::string& name) const {
  struct stat there {};
  if (::fstatat(descriptor(), name.c_str(), &there, AT_SYMLINK_NOFOLLOW) == 0)
    return type_of_mode(there.st_mode);
  if (errno == ENOENT) return fs::file_type::not_found;
  refuse(name, "looked up");
}

std::vector<std::string> Folder::names() const {
  const int again = ::openat(descriptor(), ".", as_folder); // reading has a position of its own
  DIR* list = again >= 0 ? ::fdopendir(again) : nullptr;
  if (!list) throw_system_error(path_, "read");
  std::vector<std::string> names;
  while (const dirent* entry = ::readdir(list))
    if (const std::string_view name = entry->d_name; name != "." && name != "..")
      names.emplace_back(name);
  ::closedir(list);
  std::ranges::sort(names);
  return names;
}

void Folder::refuse_read_only() const {
  if (::faccessat(descriptor(), ".", W_OK | X_OK, AT_EACCESS) != 0)
    throw_system_error(path_, "written to");
}

void Folder::remove(const std::string& name) const {
  if (::unlinkat(descriptor(), name.c_str(), 0) != 0 && errno != ENOENT) refuse(name, "removed");
}

void Folder::remove_if_empty(const std::string& name) const {
  if (::unlinkat(descriptor(), name.c_str(), AT_REMOVEDIR) != 0 && errno != ENOENT &&
      errno != ENOTEMPTY && errno != EEXIST)
    refuse(name, "removed");
}

void Folder::rename(const std::string& from, const std::string& to) const {
  if (::renameat(descriptor(), from.c_str(), descriptor(), to.c_str()) != 0) refuse(to, "created");
}

void Folder::synchronise() const { ::fsync(descriptor()); }

bool Folder::lock(Sharing sharing) const {
  const int kind = sharing == Sharing::shared ? LOCK_SH : LOCK_EX;
  return ::flock(descriptor(), kind | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

bool Folder::is_in_place() const {
  struct stat open {
  }, there{};
  return ::fstat(descriptor(), &open) == 0 &&
         ::stat(path_.empty() ? "." : path_.c_str(), &there) == 0 && open.st_dev == there.st_dev &&
         open.st_ino == there.st_ino;
}

Place::Place(const fs::path& file) : folder(file.parent_path()), name(file.filename().string()) {}

void Place::refuse_other_kinds() const {
  const fs::file_type type = folder.type_of(name);
  if (type == fs::file_type::symlink)
    throw StoreError(fmt::format("{}: cannot be replaced: it is a symbolic link; move it away",
                                 path().string()));
  if (type != fs::file_type::regular && type != fs::file_type::not_found)
    throw StoreError(
        fmt::format("{}: cannot be replaced: it is not a regular file", path().string()));
}

} // namespace lamella
