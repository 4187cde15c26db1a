#include "fields/start_image.h"

#include "fields/contour.h"
#include "fields/image_lattice.h"
#include "fields/smooth.h"
#include "fields/spline_geometry.h"
#include "scene/keys.h"

#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkStreamingDemandDrivenPipeline.h>

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

/// Nodes on either side of those of a box.
struct Margins {
  std::array<int, 3> before{}, after{};
};

/// Of nodes along an axis, the next number that the solver takes.
int solver_nodes(int nodes) {
  constexpr int multiple = 8, least = 16;
  return std::max(least, (nodes + multiple - 1) / multiple * multiple);
}

/// That the solver needs around an image: what is asked for, and what makes a number of nodes that
/// it takes. Throws InputError for more than it takes.
Margins solver_margins(const std::array<int, 3>& nodes, Margins margins) {
  const Key& key = *find_key("grid", "nodes");
  for (int a = 0; a < 3; ++a) {
    const int with = margins.before[a] + nodes[a] + margins.after[a],
              more = solver_nodes(with) - with;
    margins.before[a] += more / 2;
    margins.after[a] += more - more / 2;
    if (!key.range.contains(solver_nodes(with)))
      throw InputError(fmt::format("the image has {} nodes; along each axis the solver takes {} "
                                   "(vtkImageResample makes it coarser)",
                                   fmt::join(nodes, " x "), allowed_text(key)));
  }
  return margins;
}

ImagePlace with_margins(const ImagePlace& image, const Margins& margins) {
  ImagePlace place = image;
  for (int a = 0; a < 3; ++a) {
    place.grid.nodes[a] += margins.before[a] + margins.after[a];
    place.center[a] +=
        image.grid.origin(a) - margins.before[a] * image.grid.spacing - place.grid.origin(a);
  }
  return place;
}

/// That bring the inside so far from the sides of the box that the solver can measure the membrane.
Margins clearance_of(const Frame& frame) {
  constexpr int least = 3; // spacings
  const Grid& grid = frame.grid;
  Margins margins;
  for (std::size_t n = 0; n < grid.size(); ++n) {
    if (!(frame.phi[n] < 0)) continue;
    const std::array<int, 3> at{int(n % grid.nx()), int(n / grid.nx() % grid.ny()),
                                int(n / grid.nx() / grid.ny())};
    for (int a = 0; a < 3; ++a) {
      margins.before[a] = std::max(margins.before[a], least - at[a]);
      margins.after[a] = std::max(margins.after[a], least - (grid.nodes[a] - 1 - at[a]));
    }
  }
  return margins;
}

/// Throws for a unit of length in which the solver has no such box.
void check_unit(const Grid& grid) {
  const Key& key = *find_key("grid", "half_width");
  const double half_width = 0.5 * grid.spacing * std::ranges::min(grid.nodes);
  if (key.range.contains(half_width)) return;
  const std::string scale = fmt::format("{:.1g}", 1 / half_width);
  throw InputError(fmt::format("half the width of the image is {:.3g}, and the solver takes {}; "
                               "vtkImageChangeInformation with SetSpacingScale({}, {}, {}) and "
                               "SetOriginScale({}, {}, {}) changes the unit of length",
                               half_width, allowed_text(key), scale, scale, scale, scale, scale,
                               scale));
}

void widen(ImageVesicle& vesicle) {
  Frame& frame = vesicle.frame;
  const Grid from = frame.grid;
  const Margins margins = solver_margins(from.nodes, clearance_of(frame));
  const auto [to, center] = with_margins(ImagePlace{from, vesicle.center}, margins);
  if (to == from) return;
  const auto wider = [&](const std::vector<double>& values, double slope) {
    return widened(values, from.nodes, to.nodes, margins.before, slope);
  };
  frame.grid = to;
  frame.phi = wider(frame.phi, from.spacing);
  for (auto& [name, values] : frame.fields) values = wider(values, 0);
  vesicle.center = center;
  add_remark(vesicle.remark, fmt::format("the box was widened from {} to {} nodes, multiples of 8",
                                         fmt::join(from.nodes, " x "), fmt::join(to.nodes, " x ")));
}

} // namespace

ImagePlace place_of(const Lattice& lattice) {
  ImagePlace place{evened(lattice)};
  for (int a = 0; a < 3; ++a) place.center[a] = lattice.first[a] - place.grid.origin(a);
  return place;
}

ImagePlace announced_place(vtkInformation& info) {
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkNew<vtkImageData> image;
  if (info.Has(Pipeline::WHOLE_EXTENT())) image->SetExtent(info.Get(Pipeline::WHOLE_EXTENT()));
  if (info.Has(vtkDataObject::SPACING())) image->SetSpacing(info.Get(vtkDataObject::SPACING()));
  if (info.Has(vtkDataObject::ORIGIN())) image->SetOrigin(info.Get(vtkDataObject::ORIGIN()));
  if (info.Has(vtkDataObject::DIRECTION()))
    image->SetDirectionMatrix(info.Get(vtkDataObject::DIRECTION()));
  return place_of(ImageLattice(*image, false).lattice());
}

ImagePlace solver_place(const ImagePlace& image) {
  return with_margins(image, solver_margins(image.grid.nodes, {}));
}

ImageVesicle start_of(ImageVesicle vesicle) {
  Frame& frame = vesicle.frame;
  frame.time = 0;
  const double slope = slope_of(frame);
  if (!(slope > 1e-300) || !std::isfinite(slope))
    throw InputError("phi is flat where it vanishes; it must change sign across the membrane");
  if (slope > steepest || slope < 1 / steepest)
    for (double& phi : frame.phi) phi /= slope;
  widen(vesicle);
  check_unit(frame.grid);
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
