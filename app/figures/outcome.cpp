#include "figures/outcome.h"

#include "render/phases.h"
#include "store/history.h"

#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataConnectivityFilter.h>
#include <vtkTriangle.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace lamella {
namespace {

constexpr double noticeable = 0.04; ///< of the largest radius
constexpr std::size_t directions = 120, heights = 40;

/// The maxima of a list that rise above the minima beside them by more than a threshold. Before
/// and after the list there is 0.
int count_maxima(const std::vector<double>& values, double threshold) {
  int count = 0;
  bool rising = true;
  double extreme = 0; // since the last turn
  for (std::size_t n = 0; n <= values.size(); ++n) {
    const double value = n < values.size() ? values[n] : 0;
    if (rising ? value > extreme : value < extreme) extreme = value;
    if (rising && value < extreme - threshold) ++count, rising = false, extreme = value;
    if (!rising && value > extreme + threshold) rising = true, extreme = value;
  }
  return count;
}

/// The largest distance from the z axis through the middle, by the bin that `bin_of` gives as a
/// share; empty ones are like the one before.
template <class BinOf>
std::vector<double> largest_radii(vtkPolyData& mesh, std::size_t bins, BinOf&& bin_of) {
  std::array<double, 6> box{};
  mesh.GetBounds(box.data());
  std::vector<double> radii(bins, 0);
  for (vtkIdType n = 0; n < mesh.GetNumberOfPoints(); ++n) {
    Vec3 p;
    mesh.GetPoint(n, p.data());
    const double x = p[0] - (box[0] + box[1]) / 2, y = p[1] - (box[2] + box[3]) / 2;
    const double s = bin_of(x, y, (p[2] - box[4]) / (box[5] - box[4]));
    double& radius = radii[std::min(std::size_t(s * double(bins)), bins - 1)];
    radius = std::max(radius, std::hypot(x, y));
  }
  for (std::size_t n = 1; n < bins; ++n)
    if (radii[n] == 0) radii[n] = radii[n - 1];
  return radii;
}

int count_arms(const render::Surface& surface) {
  std::vector<double> radii =
      largest_radii(*surface.mesh, directions, [](double x, double y, double) {
        return 0.5 + std::atan2(y, x) / (2 * std::numbers::pi);
      });
  const double largest = std::ranges::max(radii);
  if (std::ranges::min(radii) > (1 - noticeable) * largest) return 0;
  std::ranges::rotate(radii, std::ranges::min_element(radii)); // so that no arm is cut in two
  return count_maxima(radii, noticeable * largest);
}

int count_beads(const render::Surface& surface) {
  const std::vector<double> radii =
      largest_radii(*surface.mesh, heights, [](double, double, double height) { return height; });
  return count_maxima(radii, noticeable * std::ranges::max(radii));
}

double area_of(vtkPolyData& mesh) {
  double area = 0;
  for (vtkIdType n = 0; n < mesh.GetNumberOfCells(); ++n)
    if (auto* triangle = vtkTriangle::SafeDownCast(mesh.GetCell(n)))
      area += triangle->ComputeArea();
  return area;
}

/// The length of the edges that belong to one triangle alone.
double rim_of(vtkPolyData& mesh) {
  std::map<std::pair<vtkIdType, vtkIdType>, int> uses;
  for (vtkIdType n = 0; n < mesh.GetNumberOfCells(); ++n) {
    vtkIdList* ids = mesh.GetCell(n)->GetPointIds();
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
      ++uses[std::minmax({ids->GetId(i), ids->GetId((i + 1) % ids->GetNumberOfIds())})];
  }
  double length = 0;
  for (const auto& [edge, count] : uses) {
    if (count != 1) continue;
    Vec3 a, b;
    mesh.GetPoint(edge.first, a.data());
    mesh.GetPoint(edge.second, b.data());
    length += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  }
  return length;
}

int count_buds(const render::Surface& surface) {
  int buds = 0;
  for (const render::Patch& patch : surface.parts) {
    if (patch.part != render::Part::Ld) continue;
    vtkNew<vtkPolyDataConnectivityFilter> pieces;
    pieces->SetInputData(patch.mesh);
    pieces->SetExtractionModeToAllRegions();
    pieces->Update();
    const int count = pieces->GetNumberOfExtractedRegions();
    for (int n = 0; n < count; ++n) {
      pieces->SetExtractionModeToSpecifiedRegions();
      pieces->InitializeSpecifiedRegionList();
      pieces->AddSpecifiedRegion(n);
      pieces->Update();
      const double rim = rim_of(*pieces->GetOutput());
      const double flat = rim * rim / (4 * std::numbers::pi);
      if (rim > 0 && area_of(*pieces->GetOutput()) > 2 * flat) ++buds;
    }
  }
  return buds;
}

} // namespace

std::optional<double> outcome_of(const render::State& state, const std::string& name) {
  const std::map<std::string, int (*)(const render::Surface&)> counts{
      {"arms", count_arms}, {"beads", count_beads}, {"buds", count_buds}};
  if (const auto count = counts.find(name); count != counts.end())
    return count->second(render::extract_surface(state.frame));
  return value_of(state.measures, name);
}

std::vector<std::string> surprises(const render::State& state, const Expectations& expect) {
  std::vector<std::string> all;
  for (const auto& [name, range] : expect) {
    const std::optional<double> value = outcome_of(state, name);
    const std::string wanted = range[0] == range[1]
                                   ? fmt::format("{:g}", range[0])
                                   : fmt::format("{:g} to {:g}", range[0], range[1]);
    if (!value)
      all.push_back(fmt::format("{} is not known of this run, expected {}", name, wanted));
    else if (!(*value >= range[0] && *value <= range[1]))
      all.push_back(fmt::format("{} is {:g}, expected {}", name, *value, wanted));
  }
  return all;
}

} // namespace lamella
