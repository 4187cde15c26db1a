#include "dynamics/start.h"

#include "error.h"
#include "scene/shapes.h"
#include "store/frame.h"

#include <fmt/format.h>

namespace lamella {

namespace {

std::string grid_text(const Grid& grid) {
  return fmt::format("{} x {} x {} nodes with a spacing of {:.6g}", grid.nx(), grid.ny(), grid.nz(),
                     grid.spacing);
}

} // namespace

Start start_of(const Scene& scene) {
  const Grid grid = scene.grid();
  if (scene.shape.kind != ShapeKind::frame)
    return {.phi = initial_phi(scene.shape, grid, scene.perturbation),
            .exact = Start::Exact{exact_area(scene.shape), exact_volume(scene.shape)}};
  Frame frame = read_frame(scene.shape.file);
  if (frame.grid != grid)
    throw RunError(
        fmt::format("the frame has {}, the scene {}; grid.nodes and grid.half_width must "
                    "be those of the frame",
                    grid_text(frame.grid), grid_text(grid)));
  return {.phi = std::move(frame.phi),
          .psi = std::move(frame.psi),
          .c = std::move(frame.c),
          .exact = {},
          .cells = frame.cells};
}

} // namespace lamella
