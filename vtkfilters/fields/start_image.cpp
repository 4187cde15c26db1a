#include "fields/start_image.h"

#include "fields/contour.h"
#include "fields/smooth.h"
#include "fields/spline_geometry.h"
#include "scene/keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

constexpr double steepest = 2; // mean slope that is left as it is, and its inverse

/// Mean |grad phi| on the membrane.
double slope_of(const Frame& frame) {
  const LevelSet phi = fitted(frame.grid, frame.phi);
  const auto mesh = contour(frame);
  const std::vector<double> slopes = slopes_at(phi, *mesh->GetPoints());
  double sum = 0;
  for (const double slope : slopes) sum += slope;
  return sum / double(slopes.size());
}

void check_nodes(const Grid& grid) {
  const Key& key = *find_key("grid", "nodes");
  if (!std::ranges::all_of(grid.nodes, [&](int n) { return key.range.contains(n); }))
    throw InputError(fmt::format("the image has {} nodes; along each axis the solver takes {} "
                                 "(vtkImageResample brings it there)",
                                 fmt::join(grid.nodes, " x "), allowed_text(key)));
}

} // namespace

Frame start_frame(const ImageVesicle& vesicle) {
  Frame frame = vesicle.frame;
  check_nodes(frame.grid);
  frame.time = 0;
  const double slope = slope_of(frame);
  if (!(slope > 1e-300) || !std::isfinite(slope))
    throw InputError("phi is flat where it vanishes; it must change sign across the membrane");
  if (slope > steepest || slope < 1 / steepest)
    for (double& phi : frame.phi) phi /= slope;
  level_off(frame.grid, frame.phi);
  return frame;
}

Scene with_start(Scene scene, const Frame& frame) {
  scene.nodes = frame.grid.nodes;
  scene.half_width = 0.5 * frame.grid.spacing * *std::ranges::min_element(scene.nodes);
  scene.shape = {.kind = ShapeKind::frame, .file = "input"};
  scene.domains = {.kind = frame.psi.empty() ? DomainsKind::none : DomainsKind::frame};
  return scene;
}

} // namespace lamella
