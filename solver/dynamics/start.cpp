#include "dynamics/start.h"

#include "error.h"
#include "scene/densities.h"
#include "scene/domains.h"
#include "scene/shapes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lamella {

namespace {

std::string grid_text(const Grid& grid) {
  return fmt::format("{} x {} x {} nodes with a spacing of {:.6g}", grid.nx(), grid.ny(), grid.nz(),
                     grid.spacing);
}

void check_grid(const Frame& frame, const Grid& grid) {
  if (frame.grid != grid)
    throw RunError(
        fmt::format("the frame has {}, the scene {}; grid.nodes and grid.half_width must "
                    "be those of the frame",
                    grid_text(frame.grid), grid_text(grid)));
}

/// The phases of a stored state, in the box of the frame that the membrane is from.
std::vector<double> stored_psi(const Scene& scene, const Frame& membrane) {
  const std::string& own_file = scene.domains.file;
  Frame frame = own_file.empty() ? membrane : read_frame(own_file);
  check_grid(frame, scene.grid());
  if (!frame.has("psi"))
    throw RunError(fmt::format("the frame {} has one phase; domains.kind must be \"none\", or "
                               "domains.file a frame with two phases",
                               own_file.empty() ? scene.shape.file : own_file));
  std::array<int, 3> cells = membrane.cells;
  for (int i = 0; i < 3; ++i) cells[i] -= frame.cells[i];
  std::vector<double> psi = std::move(frame.fields.at("psi"));
  shift(frame.grid, cells, psi);
  return psi;
}

std::string arrays_text(const Frame& frame) {
  std::vector<std::string> names;
  for (const auto& [name, values] : frame.fields) names.push_back(name);
  return names.empty() ? "there is none but the membrane's"
                       : fmt::format("there are {}", fmt::join(names, ", "));
}

} // namespace

Start start_of(const Scene& scene, Frame frame) {
  check_grid(frame, scene.grid());
  Start start{.cells = frame.cells};
  if (scene.has_phases()) start.fields["psi"] = stored_psi(scene, frame);
  if (scene.stretch.modulus > 0 && frame.has("c"))
    start.fields["c"] = std::move(frame.fields.at("c"));
  for (const MaterialField& field : scene.fields) {
    const auto array = array_of(field, scene.parameters);
    if (!array) continue;
    if (!frame.has(*array))
      throw RunError(fmt::format("the field {} starts from an array \"{}\" that is not there; {}",
                                 field.name, *array, arrays_text(frame)));
    start.fields[field.name] = frame.fields.at(*array);
  }
  start.phi = std::move(frame.phi);
  return start;
}

Start start_of(const Scene& scene) {
  if (scene.shape.kind == ShapeKind::frame) return start_of(scene, read_frame(scene.shape.file));
  const std::vector<BulgedCap> bulges = bulged_caps(scene);
  Start start{.phi = initial_phi(scene.shape, scene.grid(), scene.perturbation, bulges)};
  if (scene.has_phases()) start.fields["psi"] = initial_psi(scene);
  if (bulges.empty())
    start.exact = {exact_area(scene.shape), exact_volume(scene.shape), exact_area_ld(scene)};
  return start;
}

} // namespace lamella
