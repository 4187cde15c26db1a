#include "output_folder.h"

#include "error.h"
#include "usage_error.h"

#include <fmt/format.h>

#include <cerrno>
#include <ranges>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace lamella {

namespace fs = std::filesystem;

namespace {

void refuse_what_is_no_folder(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  const bool leads_nowhere =
      !fs::exists(status) && fs::is_symlink(fs::symlink_status(path, ignored));
  if (leads_nowhere || (fs::exists(status) && !fs::is_directory(status)))
    throw StoreError(
        fmt::format("{}: exists and is not a folder; choose another with -o", path.string()));
}

/// Makes what is missing on the way to a folder, the outermost first.
std::vector<fs::path> make(const fs::path& folder) {
  std::vector<fs::path> made;
  fs::path way;
  for (const fs::path& part : folder) {
    way /= part;
    if (::mkdir(way.c_str(), 0777) == 0) {
      made.push_back(way);
      continue;
    }
    const std::error_code why(errno == EEXIST ? ENOTDIR : errno, std::generic_category());
    if (std::error_code ignored; !fs::is_directory(way, ignored))
      throw StoreError(
          fmt::format("{}: cannot be used as output folder: {}", folder.string(), why.message()));
  }
  return made;
}

} // namespace

OutputFolder::OutputFolder(const fs::path& path) {
  refuse_what_is_no_folder(path);
  do { // another process may remove what it made in vain
    const std::vector<fs::path> made = make(path);
    made_.insert(made_.end(), made.begin(), made.end());
    folder_.emplace(path);
    if (!folder_->lock(Folder::Sharing::exclusive))
      throw UsageError(path.string() + ": another lamella is writing to this folder");
  } while (!folder_->is_in_place());
  folder_->refuse_read_only();
}

OutputFolder::~OutputFolder() {
  for (const fs::path& folder : made_ | std::views::reverse)
    if (::rmdir(folder.c_str()) != 0) return; // something is in it
}

Folder hold_run(const fs::path& folder) {
  Folder held(folder);
  held.lock(Folder::Sharing::shared);
  return held;
}

} // namespace lamella
