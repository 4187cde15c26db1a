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

/// Fields on a wider grid, so many nodes before the first: beyond the old ones their last values,
/// plus the distance from there times `slope`.
std::vector<double> widened(const std::vector<double>& values, const Grid& from, const Grid& to,
                            const std::array<int, 3>& before, double slope) {
  std::vector<double> out;
  if (values.empty()) return out;
  for (int k = 0; k < to.nz(); ++k)
    for (int j = 0; j < to.ny(); ++j)
      for (int i = 0; i < to.nx(); ++i) {
        const std::array<int, 3> at{i - before[0], j - before[1], k - before[2]};
        std::array<int, 3> nearest, off;
        for (int a = 0; a < 3; ++a) {
          nearest[a] = std::clamp(at[a], 0, from.nodes[a] - 1);
          off[a] = at[a] - nearest[a];
        }
        out.push_back(values[from.index(nearest[0], nearest[1], nearest[2])] +
                      slope * from.spacing * std::hypot(off[0], off[1], off[2]));
      }
  return out;
}

std::array<int, 3> nodes_before(const Grid& from, const Grid& to) {
  std::array<int, 3> before;
  for (int a = 0; a < 3; ++a) before[a] = (to.nodes[a] - from.nodes[a]) / 2;
  return before;
}

void widen(ImageVesicle& vesicle) {
  Frame& frame = vesicle.frame;
  const Grid from = frame.grid;
  const auto [to, center] = solver_place(Place{from, vesicle.center});
  if (to == from) return;
  const std::array<int, 3> before = nodes_before(from, to);
  frame.grid = to;
  frame.phi = widened(frame.phi, from, to, before, 1);
  frame.psi = widened(frame.psi, from, to, before, 0);
  frame.c = widened(frame.c, from, to, before, 0);
  vesicle.center = center;
  vesicle.remark += fmt::format("{}the box was widened from {} to {} nodes, multiples of 8",
                                vesicle.remark.empty() ? "" : "; ", fmt::join(from.nodes, " x "),
                                fmt::join(to.nodes, " x "));
}

/// Of nodes along an axis, the next number that the solver takes.
int solver_nodes(int nodes) {
  constexpr int multiple = 8, least = 16;
  return std::max(least, (nodes + multiple - 1) / multiple * multiple);
}

/// Throws where the solver could not measure the membrane for the sides of the box.
void check_clearance(const Frame& frame) {
  constexpr int least = 3; // spacings
  const Grid& grid = frame.grid;
  for (std::size_t n = 0; n < grid.size(); ++n) {
    const std::array<int, 3> at{int(n % grid.nx()), int(n / grid.nx() % grid.ny()),
                                int(n / grid.nx() / grid.ny())};
    for (int a = 0; a < 3; ++a)
      if (frame.phi[n] < 0 && (at[a] < least || at[a] >= grid.nodes[a] - least))
        throw InputError(fmt::format("the membrane comes within {} nodes of a side of the image "
                                     "along {}; leave more room (vtkImageConstantPad makes some)",
                                     least, "xyz"[a]));
  }
}

} // namespace

Place solver_place(const Place& image) {
  const Key& key = *find_key("grid", "nodes");
  Place place = image;
  for (int a = 0; a < 3; ++a) place.grid.nodes[a] = solver_nodes(image.grid.nodes[a]);
  if (!std::ranges::all_of(place.grid.nodes, [&](int n) { return key.range.contains(n); }))
    throw InputError(fmt::format("the image has {} nodes; along each axis the solver takes {} "
                                 "(vtkImageResample makes it coarser)",
                                 fmt::join(image.grid.nodes, " x "), allowed_text(key)));
  const std::array<int, 3> before = nodes_before(image.grid, place.grid);
  for (int a = 0; a < 3; ++a)
    place.center[a] += image.grid.origin(a) - before[a] * image.grid.spacing - place.grid.origin(a);
  return place;
}

Place solver_place(const Lattice& image) {
  Place place{evened(image)};
  for (int a = 0; a < 3; ++a) place.center[a] = image.first[a] - place.grid.origin(a);
  return solver_place(place);
}

ImageVesicle start_of(ImageVesicle vesicle) {
  Frame& frame = vesicle.frame;
  frame.time = 0;
  check_clearance(frame);
  const double slope = slope_of(frame);
  if (!(slope > 1e-300) || !std::isfinite(slope))
    throw InputError("phi is flat where it vanishes; it must change sign across the membrane");
  if (slope > steepest || slope < 1 / steepest)
    for (double& phi : frame.phi) phi /= slope;
  widen(vesicle);
  level_off(frame.grid, frame.phi);
  return vesicle;
}

Scene with_start(Scene scene, const Grid& grid, bool has_phases) {
  scene.nodes = grid.nodes;
  scene.half_width = 0.5 * grid.spacing * *std::ranges::min_element(scene.nodes);
  scene.shape = {.kind = ShapeKind::frame, .file = "input"};
  scene.domains = {.kind = has_phases ? DomainsKind::frame : DomainsKind::none};
  return scene;
}

} // namespace lamella
