#include "fields/stored_frame.h"

#include <fmt/format.h>

#include <atomic>
#include <unistd.h>

namespace lamella {
namespace {

std::filesystem::path unused_path() {
  static std::atomic<int> count = 0;
  std::error_code ignored;
  return std::filesystem::temp_directory_path(ignored) /
         fmt::format("lamella-frame-{}-{}.hdf", getpid(), count++);
}

} // namespace

StoredFrame::StoredFrame(const Frame& frame) : path_(unused_path()) { write_frame(path_, frame); }

StoredFrame::~StoredFrame() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

} // namespace lamella
