#include "start_frame.h"

#include "error.h"
#include "find_scene.h"
#include "progress.h"
#include "store/frame.h"
#include "time_loop.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace lamella {

namespace fs = std::filesystem;

namespace {

/// The last state of a scene, which is not stored on the way.
Frame end_of(Scene scene) {
  const StartFrame start_frame(scene);
  Simulation sim = start(scene);
  const Outcome outcome = TimeLoop(sim, scene).run([](bool) {});
  if (outcome.code == run_stopped)
    throw SceneError(fmt::format("{}: no start for another run: it {}", scene.name,
                                 words_for(outcome, sim.time())));
  return sim.frame();
}

/// A new folder for temporary files.
fs::path temporary_folder() {
  std::string name = (fs::temp_directory_path() / "lamella-start-XXXXXX").string();
  if (!mkdtemp(name.data()))
    throw StoreError(
        fmt::format("{}: cannot be created: {}", name, std::generic_category().message(errno)));
  return name;
}

} // namespace

StartFrame::StartFrame(Scene& scene) {
  if (scene.shape.kind != ShapeKind::frame || fs::path(scene.shape.file).is_absolute()) return;
  Scene earlier = find_scene(scene.shape.file, {});
  earlier.nodes = scene.nodes;
  earlier.half_width = scene.half_width;
  validate(earlier, [&](std::span<const std::string_view> keys) -> KeyPlace {
    return {keys.front(), fmt::format("{} on the grid of {}: ", earlier.name, scene.name)};
  });
  say(fmt::format("{} starts where {} ends, which runs first and is not stored\n", scene.name,
                  earlier.name));
  const Frame frame = end_of(earlier);
  temporary_ = temporary_folder();
  scene.shape.file = temporary_ / "start.hdf";
  write_frame(scene.shape.file, frame);
}

StartFrame::~StartFrame() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove_all(temporary_, ignored);
}

} // namespace lamella
