#include "fields/image.h"

#include "fields/image_lattice.h"
#include "fields/mask.h"
#include "fields/start_image.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace lamella {
namespace {

constexpr int least_nodes = 8;                  // along an axis: what a spline needs
constexpr double most_nodes = 512. * 512 * 512; // of what is resampled

std::string names_of_arrays(vtkDataSetAttributes& data) {
  std::vector<std::string> names;
  for (int a = 0; a < data.GetNumberOfArrays(); ++a)
    if (const char* name = data.GetArrayName(a)) names.push_back(name);
  return names.empty() ? "no named ones" : fmt::format("{}", fmt::join(names, ", "));
}

/// The point data of an image, or else its cell data: that with the array of a name, or with any.
vtkDataSetAttributes& data_with(vtkImageData& image, const std::string& name) {
  vtkDataSetAttributes *points = image.GetPointData(), *cells = image.GetCellData();
  if (points->GetArray(name.c_str())) return *points;
  if (cells->GetArray(name.c_str())) return *cells;
  return points->GetNumberOfArrays() > 0 || cells->GetNumberOfArrays() == 0 ? *points : *cells;
}

vtkDataArray& find_phi(vtkDataSetAttributes& data, const std::string& name) {
  if (vtkDataArray* array = data.GetArray(name.c_str())) return *array;
  if (data.GetNumberOfArrays() == 0)
    throw InputError(fmt::format("the image has no data; a level set \"{}\" is needed, negative "
                                 "inside the membrane",
                                 name));
  if (data.GetNumberOfArrays() > 1 || !data.GetArray(0))
    throw InputError(fmt::format("the image has no array \"{}\"; it has {}: choose one by "
                                 "SetPhiArray()",
                                 name, names_of_arrays(data)));
  return *data.GetArray(0);
}

std::vector<double> values_of(vtkDataArray& array) {
  const std::string name = array.GetName() ? array.GetName() : "";
  if (array.GetNumberOfComponents() != 1)
    throw InputError(fmt::format("the array \"{}\" has {} components, and a field has one; "
                                 "vtkImageExtractComponents with SetComponents(0) takes the first",
                                 name, array.GetNumberOfComponents()));
  vtkNew<vtkDoubleArray> doubles;
  doubles->DeepCopy(&array);
  const std::vector<double> values(doubles->GetPointer(0),
                                   doubles->GetPointer(0) + doubles->GetNumberOfTuples());
  const auto bad =
      std::ranges::count_if(values, [](double value) { return !std::isfinite(value); });
  if (bad > 0)
    throw InputError(
        fmt::format("{} of the {} values of \"{}\" are not finite", bad, values.size(), name));
  return values;
}

/// The grid that an image is brought onto.
Grid grid_for(const Lattice& lattice) {
  const Grid grid = evened(lattice);
  if (double(grid.nx()) * grid.ny() * grid.nz() > most_nodes)
    throw InputError(fmt::format("the image has spacings of {:g}; resampled to the smallest it "
                                 "would have {} nodes (vtkImageResample makes it coarser)",
                                 fmt::join(lattice.spacing, ", "), fmt::join(grid.nodes, " x ")));
  return grid;
}

std::string remark_on(const Lattice& lattice, const Grid& grid) {
  if (lattice.is_even()) return {};
  return fmt::format("the image has spacings of {:g}: resampled to {} nodes with a spacing of {:g}",
                     fmt::join(lattice.spacing, ", "), fmt::join(grid.nodes, " x "), grid.spacing);
}

bool is_label(double value) { return value >= 0 && value == std::floor(value) && value < 2e9; }

/// The values of an image and how often each is there; none where they are more than so many.
std::map<double, std::size_t> values_in(const std::vector<double>& values, std::size_t most) {
  std::map<double, std::size_t> count;
  for (const double value : values) {
    ++count[value];
    if (count.size() > most) return {};
  }
  return count;
}

std::string list_of_labels(const std::map<double, std::size_t>& labels) {
  constexpr std::size_t most = 8;
  std::vector<std::string> listed;
  for (const auto& [label, voxels] : labels)
    if (listed.size() < most) listed.push_back(fmt::format("{:g} ({} voxels)", label, voxels));
  return fmt::format("{}{}", fmt::join(listed, ", "),
                     labels.size() > most ? fmt::format(" and {} more", labels.size() - most) : "");
}

/// Throws for labels.
void check_is_no_label(const std::vector<double>& phi) {
  constexpr std::size_t most = 1000, most_with_signs = 16; // of level sets that are whole numbers
  if (!std::ranges::all_of(phi, [](double value) { return value == std::floor(value); })) return;
  const bool has_signs = std::ranges::min(phi) < 0;
  const auto labels = values_in(phi, has_signs ? most_with_signs : most);
  if (labels.size() < 3) return;
  const auto label = std::ranges::find_if(labels, [](const auto& one) { return one.first > 0; });
  throw InputError(fmt::format(
      "the image has labels in place of a level set: {}; vtkVesicleFromImage with SetLabel({:g}) "
      "takes one of them for the inside, or, of gray values, vtkImageThreshold makes a mask",
      list_of_labels(labels), label == labels.end() ? 0 : label->first));
}

/// Throws where a level set has no zeros.
void check_values(const std::vector<double>& phi) {
  const auto [least, greatest] = std::ranges::minmax(phi);
  if (least == greatest)
    throw InputError(fmt::format("there is no membrane: phi is {:g} everywhere", least));
  check_is_no_label(phi);
  if (least < 0 && greatest > 0) return;
  throw InputError(
      fmt::format("there is no membrane: phi goes from {:g} to {:g}, and is nowhere {}; it must be "
                  "negative inside and positive outside, or a mask of two values, which "
                  "vtkImageThreshold makes",
                  least, greatest, least < 0 ? "positive" : "negative"));
}

/// Throws where products of phi and its derivatives would leave the range of numbers.
void check_size(const std::vector<double>& phi) {
  constexpr double least = 1e-60, most = 1e60;
  const auto [low, high] = std::ranges::minmax(phi);
  const double largest = std::max(-low, high);
  if (largest > most || (largest > 0 && largest < least))
    throw InputError(fmt::format("phi goes from {:g} to {:g}; it should be about a distance from "
                                 "the membrane",
                                 low, high));
}

/// Throws where some of the inside is at the sides of the box.
void check_sides(const Frame& frame) {
  const Grid& grid = frame.grid;
  std::size_t at_sides = 0, inside = 0;
  for (std::size_t n = 0; n < grid.size(); ++n) {
    const std::array<int, 3> at{int(n % grid.nx()), int(n / grid.nx() % grid.ny()),
                                int(n / grid.nx() / grid.ny())};
    bool is_at_side = false;
    for (int a = 0; a < 3; ++a) is_at_side |= at[a] == 0 || at[a] + 1 == grid.nodes[a];
    at_sides += is_at_side;
    inside += is_at_side && frame.phi[n] <= 0;
  }
  if (inside == 0) return;
  throw InputError(fmt::format(
      "the membrane is not closed: phi is not positive everywhere at the sides of the image; it "
      "must be negative inside, positive outside{}",
      2 * inside > at_sides ? " (vtkImageMathematics with SetOperationToMultiplyByK() and "
                              "SetConstantK(-1) turns the sides round)"
                            : ", and the image must hold all of the inside"));
}

/// What is inside in a mask, where values are of a mask.
struct Inside {
  double value;
  std::string inverted; ///< what to do where it is the outside
};

std::optional<Inside> inside_of_mask(const std::vector<double>& values, const Selection& selection,
                                     std::string& remark) {
  if (selection.label >= 0) {
    const auto count = std::ranges::count(values, double(selection.label));
    if (count == 0)
      throw InputError(fmt::format("no voxel has the label {}; the image has {}", selection.label,
                                   list_of_labels(values_in(values, values.size()))));
    add_remark(remark, fmt::format("{} voxels of label {} are inside", count, selection.label));
    return Inside{double(selection.label), "SetLabel() must be that of the inside"};
  }
  const auto two = values_in(values, 2);
  if (two.size() != 2) return {};
  const double low = two.begin()->first, high = two.rbegin()->first, inside = low < 0 ? low : high,
               outside = low < 0 ? high : low;
  add_remark(remark, fmt::format("phi is {:g} or {:g}: taken for a mask, inside where it is {:g}",
                                 low, high, inside));
  return Inside{inside, is_label(outside)
                            ? fmt::format("vtkVesicleFromImage with SetLabel({:g}) takes the other "
                                          "voxels for the inside",
                                          outside)
                            : "vtkImageThreshold makes one of 0 and 1"};
}

void check_nodes(const Lattice& lattice) {
  if (std::ranges::min(lattice.nodes) < least_nodes)
    throw InputError(fmt::format("the image has {} nodes; along each axis {} are the least",
                                 fmt::join(lattice.nodes, " x "), least_nodes));
}

/// The fields of an image on the grid of a lattice, which may begin before the image's own.
NodalFields fields_in(vtkDataSetAttributes& data, const vtkDataArray& phi,
                      const ImageLattice& image, const Mask& mask) {
  NodalFields fields;
  for (int i = 0; i < data.GetNumberOfArrays(); ++i) {
    vtkDataArray* array = data.GetArray(i);
    if (!array || array == &phi || !array->GetName() || array->GetNumberOfComponents() != 1 ||
        (array->GetDataType() != VTK_DOUBLE && array->GetDataType() != VTK_FLOAT))
      continue;
    fields[array->GetName()] =
        resample(widened(image.in_order(values_of(*array)), image.lattice().nodes,
                         mask.lattice.nodes, mask.before),
                 mask.lattice, Interpolation::smooth);
  }
  return fields;
}

void add_array(vtkImageData& image, const char* name, const std::vector<double>& values) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(vtkIdType(values.size()));
  std::ranges::copy(values, array->GetPointer(0));
  image.GetPointData()->AddArray(array);
}

} // namespace

ImageVesicle vesicle_in(vtkImageData& image, const Selection& selection) {
  vtkDataSetAttributes& data = data_with(image, selection.phi_array);
  const ImageLattice own(image, &data == image.GetCellData());
  vtkDataArray& phi = find_phi(data, selection.phi_array);
  std::vector<double> values = own.in_order(values_of(phi));
  ImageVesicle vesicle;
  const auto inside = inside_of_mask(values, selection, vesicle.remark);
  Mask mask{own.lattice(), {}};
  if (inside) {
    mask = mask_where(values, inside->value, own.lattice(), inside->inverted, vesicle.remark);
  } else {
    if (selection.fill_cavities)
      throw InputError("there is nothing to fill: phi is a level set, and no mask or labels");
    check_values(values);
    check_size(values);
    check_nodes(own.lattice());
  }
  const Grid grid = grid_for(mask.lattice);
  add_remark(vesicle.remark, remark_on(mask.lattice, grid));
  vesicle.frame = {.grid = grid, .phi = {}, .fields = fields_in(data, phi, own, mask)};
  vesicle.center = place_of(mask.lattice).center;
  vesicle.frame.phi = inside ? phi_of(mask, selection.fill_cavities, grid, vesicle.remark)
                             : resample(std::move(values), mask.lattice, Interpolation::smooth);
  if (vtkInformation* about = image.GetInformation(); about->Has(vtkDataObject::DATA_TIME_STEP()))
    vesicle.frame.time = about->Get(vtkDataObject::DATA_TIME_STEP());
  check_sides(vesicle.frame);
  return vesicle;
}

void fill_image(vtkImageData& image, const Frame& frame, const Vec3& center) {
  const Grid& grid = frame.grid;
  Vec3 origin;
  for (int a = 0; a < 3; ++a)
    origin[a] = grid.origin(a) + frame.cells[a] * grid.spacing + center[a];
  image.Initialize();
  image.SetDimensions(grid.nodes.data());
  image.SetSpacing(grid.spacing, grid.spacing, grid.spacing);
  image.SetOrigin(origin.data());
  add_array(image, "phi", frame.phi);
  for (const auto& [name, values] : frame.fields) add_array(image, name.c_str(), values);
  image.GetPointData()->SetActiveScalars("phi");
  image.GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), frame.time);
}

} // namespace lamella
