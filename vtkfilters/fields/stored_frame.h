#pragma once
#include "store/frame.h"

#include <filesystem>

namespace lamella {

/// A frame as a file, for as long as this lives: what a scene starts from that goes on where
/// another ended.
class StoredFrame {
public:
  /// Throws StoreError.
  explicit StoredFrame(const Frame& frame);
  ~StoredFrame();
  StoredFrame(const StoredFrame&) = delete;
  StoredFrame& operator=(const StoredFrame&) = delete;

  std::string path() const { return path_.string(); }

private:
  std::filesystem::path path_;
};

} // namespace lamella
