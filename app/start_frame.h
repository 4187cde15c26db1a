#pragma once
#include "scene/scene.h"

#include <filesystem>

namespace lamella {

/// The stored state that a scene of kind "frame" starts from.
///
/// Where shape.file names a built-in scene, that scene is run first, on the grid of this one, and
/// its end is a file for as long as this lives. Does nothing for other scenes.
class StartFrame {
public:
  /// Sets shape.file to that file. Throws SceneError where the built-in scene does not come to its
  /// end, and StoreError. After an interrupt the state is that of the interrupted run.
  explicit StartFrame(Scene& scene);
  ~StartFrame();
  StartFrame(const StartFrame&) = delete;
  StartFrame& operator=(const StartFrame&) = delete;

private:
  std::filesystem::path temporary_; ///< a folder; empty: none
};

} // namespace lamella
