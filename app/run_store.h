#pragma once
#include "scene/scene.h"
#include "store/folder.h"

#include <filesystem>

namespace lamella {

/// Runs that figures are drawn from, each in a folder named after its scene and a key: a hash of
/// the whole scene, the frames it starts from and the version of this program. A folder of that
/// name holds a run that has come to its end; one on its way has another name.
class RunStore {
public:
  explicit RunStore(Folder folder) : folder_(std::move(folder)) {}

  std::filesystem::path place(const Scene& scene) const;
  bool has(const Scene& scene) const;

  /// The scene as a file, and where to run it.
  struct Order {
    std::filesystem::path scene, folder;
  };
  /// Throws StoreError, also for a link in place of the folder.
  Order begin(const Scene& scene) const;
  /// The run of that order has come to its end. Throws StoreError.
  void finish(const Scene& scene) const;

private:
  Folder folder_;
};

} // namespace lamella
