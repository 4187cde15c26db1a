#include "fields/mask.h"

#include "fields/image.h"
#include "fields/parts.h"
#include "fields/smooth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

// Of a smoothed edge, in the largest of the spacings. At 1.25, K_M of an ellipsoid went from -16 to
// 0 in place of -6.3 to -4.1, and its run broke down; at 2 from -7.5 to -2.1.
constexpr double mask_width = 2;
constexpr double margin = 2 * mask_width; // so far is the edge felt: to leave free at the sides

double largest_spacing(const Lattice& lattice) { return std::ranges::max(lattice.spacing); }

std::string counted(std::size_t count, const char* one, const char* more) {
  return fmt::format("{} {}", count, count == 1 ? one : more);
}

/// The places of voxels of a lattice.
class Voxels {
public:
  explicit Voxels(const std::array<int, 3>& nodes) : nodes_(nodes) {}

  std::size_t count() const { return std::size_t(nodes_[0]) * nodes_[1] * nodes_[2]; }
  std::array<int, 3> at(std::size_t voxel) const {
    return {int(voxel % nodes_[0]), int(voxel / nodes_[0] % nodes_[1]),
            int(voxel / nodes_[0] / nodes_[1])};
  }
  std::size_t index(const std::array<int, 3>& at) const {
    return (std::size_t(at[2]) * nodes_[1] + at[1]) * nodes_[0] + at[0];
  }
  bool is_at_side(std::size_t voxel) const {
    const std::array<int, 3> p = at(voxel);
    for (int a = 0; a < 3; ++a)
      if (p[a] == 0 || p[a] + 1 == nodes_[a]) return true;
    return false;
  }

  /// f(neighbour) along the axes, or along diagonals too.
  template <class F>
  void for_each_neighbour(std::size_t voxel, bool diagonals, F&& f) const {
    const std::array<int, 3> p = at(voxel);
    for (int n = 0; n < 27; ++n) {
      const std::array<int, 3> step{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
      const int steps = std::abs(step[0]) + std::abs(step[1]) + std::abs(step[2]);
      if (steps == 0 || (steps > 1 && !diagonals)) continue;
      std::array<int, 3> q;
      bool within = true;
      for (int a = 0; a < 3; ++a) {
        q[a] = p[a] + step[a];
        within = within && q[a] >= 0 && q[a] < nodes_[a];
      }
      if (within) f(index(q));
    }
  }

private:
  std::array<int, 3> nodes_;
};

/// Voxels that hang together.
struct Region {
  bool is_inside = false;
  int parent = 0;        ///< the region around it
  double voxels = 0;     ///< its own
  double all_voxels = 0; ///< with those of all regions within
};

/// The regions of a mask: 0 is the outside around all others, and each comes after its parent.
class Regions {
public:
  explicit Regions(const Mask& mask) : voxels_(mask.lattice.nodes), of_(mask.inside.size(), -1) {
    for (std::size_t v = 0; v < of_.size(); ++v)
      if (of_[v] < 0) add(mask, v);
    for (Region& region : regions_) region.all_voxels = region.voxels;
    for (std::size_t r = regions_.size() - 1; r > 0; --r)
      regions_[regions_[r].parent].all_voxels += regions_[r].all_voxels;
  }

  const std::vector<Region>& all() const { return regions_; }

  /// Joins the regions that are to go with their parents; those within them must be to go too.
  template <class Goes>
  void drop(Goes&& goes) {
    std::vector<int> number{0};
    std::vector<Region> kept{regions_[0]};
    for (std::size_t r = 1; r < regions_.size(); ++r) {
      Region region = regions_[r];
      region.parent = number[region.parent];
      if (goes(regions_[r])) {
        number.push_back(region.parent);
        kept[region.parent].voxels += region.voxels;
      } else {
        number.push_back(int(kept.size()));
        kept.push_back(region);
      }
    }
    regions_ = std::move(kept);
    for (int& region : of_) region = number[region];
  }

  bool is_inside(std::size_t voxel) const { return regions_[of_[voxel]].is_inside; }

  /// The region whose outer edge is next to each voxel, and how many voxels it is away; along the
  /// axes, which is near enough to tell parts apart.
  struct Edges {
    std::vector<int> region, steps;
  };
  Edges nearest_edges() const {
    Edges edges{std::vector<int>(of_.size(), -1), std::vector<int>(of_.size(), 0)};
    std::vector<std::size_t> front, next;
    for (std::size_t v = 0; v < of_.size(); ++v)
      voxels_.for_each_neighbour(v, false, [&](std::size_t other) {
        if (of_[other] == of_[v] || edges.region[v] >= 0) return;
        edges.region[v] = std::max(of_[v], of_[other]); // the inner of the two
        edges.steps[v] = 1;
        front.push_back(v);
      });
    for (; !front.empty(); std::swap(front, next), next.clear())
      for (const std::size_t v : front)
        voxels_.for_each_neighbour(v, false, [&](std::size_t other) {
          if (edges.region[other] >= 0) return;
          edges.region[other] = edges.region[v];
          edges.steps[other] = edges.steps[v] + 1;
          next.push_back(other);
        });
    return edges;
  }

private:
  /// The region of a voxel that is the first of it in their order: the one before it is around it.
  void add(const Mask& mask, std::size_t first) {
    const int number = int(regions_.size());
    const bool is_inside = mask.inside[first];
    Region region{.is_inside = is_inside, .parent = first == 0 ? 0 : of_[first - 1]};
    std::vector<std::size_t> open{first};
    of_[first] = number;
    while (!open.empty()) {
      const std::size_t v = open.back();
      open.pop_back();
      ++region.voxels;
      voxels_.for_each_neighbour(v, is_inside, [&](std::size_t other) {
        if (of_[other] >= 0 || bool(mask.inside[other]) != is_inside) return;
        of_[other] = number;
        open.push_back(other);
      });
    }
    regions_.push_back(region);
  }

  Voxels voxels_;
  std::vector<Region> regions_;
  std::vector<int> of_; ///< by voxel
};

/// The parts that go, said.
void drop_small(Regions& regions, double least, std::string& remark) {
  std::size_t specks = 0, pits = 0;
  double largest = 0;
  const auto is_small = [&](const Region& region) { return region.all_voxels < least; };
  for (const Region& region : std::span(regions.all()).subspan(1)) {
    if (!is_small(region)) continue;
    ++(region.is_inside ? specks : pits);
    if (region.is_inside) largest = std::max(largest, region.all_voxels);
  }
  if (specks > 0)
    add_remark(remark, fmt::format("{} of up to {} {} left out: {:.0f} voxels are the least that "
                                   "is left by the smoothing",
                                   counted(specks, "part of the inside", "parts of the inside"),
                                   counted(std::size_t(largest), "voxel", "voxels"),
                                   specks == 1 ? "is" : "are", std::ceil(least)));
  if (pits > 0)
    add_remark(remark, fmt::format("{} of less than {:.0f} voxels {} filled",
                                   counted(pits, "cavity", "cavities"), std::ceil(least),
                                   pits == 1 ? "is" : "are"));
  regions.drop(is_small);
  if (regions.all().size() > 1) return;
  const double radius = 2 * mask_width * std::cbrt(std::max(largest, 1.) / least);
  const std::string times = fmt::format("{:.0f}", std::ceil(2.5 * mask_width / radius));
  throw InputError(fmt::format(
      "nothing is left of the inside of the mask: its largest part has {}, and {:.0f} are the "
      "least "
      "that is left by the smoothing; vtkImageResample with "
      "SetInterpolationModeToNearestNeighbor() and SetMagnificationFactors({}, {}, {}) makes small "
      "enough ones",
      counted(std::size_t(largest), "voxel", "voxels"), std::ceil(least), times, times, times));
}

void fill(Regions& regions, std::string& remark) {
  const auto is_within = [](const Region& region) { return region.parent > 0; };
  const auto cavities = std::size_t(std::ranges::count_if(
      regions.all(), [&](const Region& r) { return is_within(r) && !r.is_inside; }));
  add_remark(remark, cavities > 0
                         ? counted(cavities, "cavity is filled", "cavities are filled")
                         : "there is no cavity to fill: the wall has gaps, or is cut by the sides "
                           "of the image; gaps must be closed first");
  regions.drop(is_within);
}

/// Says where a mask looks as if only the membrane were marked.
void remark_on_walls(const Regions& regions, const Regions::Edges& edges, std::string& remark) {
  constexpr int thin = 4;     // voxels from the edge
  constexpr double wide = 40; // times the cube of that
  double largest = 0, inside = 0;
  std::size_t cavities = 0;
  for (const Region& region : std::span(regions.all()).subspan(1)) {
    if (region.is_inside) {
      inside += region.voxels;
      continue;
    }
    ++cavities;
    largest = std::max(largest, region.all_voxels);
  }
  if (cavities > 0) {
    add_remark(remark,
               fmt::format("the inside has {}, the largest of {:.0f} voxels, which is taken "
                           "for a second membrane; if only the membrane is marked, "
                           "vtkVesicleFromImage with FillCavitiesOn() fills it",
                           counted(cavities, "cavity", "cavities"), largest));
    return;
  }
  int deepest = 0;
  for (std::size_t v = 0; v < edges.steps.size(); ++v)
    if (regions.is_inside(v)) deepest = std::max(deepest, edges.steps[v]);
  if (deepest <= thin && inside > wide * std::pow(deepest, 3))
    add_remark(remark,
               fmt::format("the inside is nowhere thicker than {} voxels; if only the "
                           "membrane is marked, close its gaps (by a morphological "
                           "closing), and vtkVesicleFromImage with FillCavitiesOn() fills it",
                           2 * deepest));
}

/// What helps where smoothing changes too much.
std::string remedy_of(const Regions& regions) {
  const bool hollow = std::ranges::any_of(std::span(regions.all()).subspan(1),
                                          [](const Region& r) { return !r.is_inside; });
  return fmt::format("{}vtkImageResample with SetInterpolationModeToNearestNeighbor() and "
                     "SetMagnificationFactors(2, 2, 2) makes smaller voxels",
                     hollow ? "if only the membrane is marked, vtkVesicleFromImage with "
                              "FillCavitiesOn() fills it, otherwise "
                            : "");
}

/// By node of a grid: the part whose edge is next, at the voxel next to it.
std::vector<int> parts_by_node(const Grid& grid, const Lattice& lattice,
                               const std::vector<int>& edges) {
  const Voxels voxels(lattice.nodes);
  std::vector<int> nearest;
  nearest.reserve(grid.size());
  for (int k = 0; k < grid.nz(); ++k)
    for (int j = 0; j < grid.ny(); ++j)
      for (int i = 0; i < grid.nx(); ++i) {
        std::array<int, 3> at{i, j, k};
        for (int a = 0; a < 3; ++a)
          at[a] = std::min(lattice.nodes[a] - 1,
                           int(std::lround(at[a] * grid.spacing / lattice.spacing[a])));
        nearest.push_back(edges[voxels.index(at)] - 1); // region 0 is no part
      }
  return nearest;
}

} // namespace

Mask mask_where(const std::vector<double>& values, double value, const Lattice& lattice,
                const std::string& inverted, std::string& remark) {
  constexpr double most = 0.5; // of the sides
  const Voxels voxels(lattice.nodes);
  std::array<int, 3> low = lattice.nodes, high{-1, -1, -1};
  double at_sides = 0, side = 0;
  for (std::size_t v = 0; v < values.size(); ++v) {
    const bool is_inside = values[v] == value, is_at_side = voxels.is_at_side(v);
    side += is_at_side;
    at_sides += is_at_side && is_inside;
    const std::array<int, 3> at = voxels.at(v);
    for (int a = 0; is_inside && a < 3; ++a) {
      low[a] = std::min(low[a], at[a]);
      high[a] = std::max(high[a], at[a]);
    }
  }
  if (at_sides > most * side)
    throw InputError(fmt::format("the inside of the mask, where it is {:g}, covers {:.0f} % of the "
                                 "sides of the image: it seems to be inverted; {}",
                                 value, 100 * at_sides / side, inverted));
  if (at_sides > 0)
    add_remark(remark, "the inside reaches the sides of the image, and is closed there");
  Mask mask{lattice, {}, {}};
  for (int a = 0; a < 3; ++a) {
    const int room = int(std::ceil(margin * largest_spacing(lattice) / lattice.spacing[a]));
    mask.before[a] = std::max(0, room - low[a]);
    mask.lattice.nodes[a] += mask.before[a] + std::max(0, room - (lattice.nodes[a] - 1 - high[a]));
    mask.lattice.first[a] -= mask.before[a] * lattice.spacing[a];
  }
  const Voxels wider(mask.lattice.nodes);
  mask.inside.resize(wider.count());
  for (std::size_t v = 0; v < values.size(); ++v) {
    std::array<int, 3> at = voxels.at(v);
    for (int a = 0; a < 3; ++a) at[a] += mask.before[a];
    mask.inside[wider.index(at)] = values[v] == value;
  }
  return mask;
}

std::vector<double> phi_of(Mask mask, bool fill_cavities, const Grid& grid, std::string& remark) {
  const Lattice& lattice = mask.lattice;
  const double largest = largest_spacing(lattice), width = mask_width * largest / grid.spacing,
               voxel = lattice.spacing[0] * lattice.spacing[1] * lattice.spacing[2];
  Regions regions(mask);
  if (fill_cavities) fill(regions, remark);
  drop_small(regions, least_volume(mask_width) * std::pow(largest, 3) / voxel, remark);
  const Regions::Edges edges = regions.nearest_edges();
  remark_on_walls(regions, edges, remark);
  std::vector<Part> parts;
  for (const Region& region : std::span(regions.all()).subspan(1))
    parts.push_back({.volume = region.all_voxels * voxel, .is_hollow = !region.is_inside});
  std::vector<double> share(mask.inside.size());
  for (std::size_t v = 0; v < share.size(); ++v) share[v] = regions.is_inside(v);
  std::vector<double> phi =
      from_share(grid, width, resample(std::move(share), lattice, Interpolation::linear));
  keep_volumes(grid, parts, parts_by_node(grid, lattice, edges.region), remedy_of(regions), phi,
               remark);
  add_remark(remark, fmt::format("the edge is smoothed over {:.3g} spacings", width));
  return phi;
}

} // namespace lamella
