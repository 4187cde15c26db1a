#include "fields/image.h"

#include "fields/resample.h"
#include "fields/smooth.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkInformation.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

constexpr int least_nodes = 8;                  // along an axis: what a spline needs
constexpr double most_nodes = 512. * 512 * 512; // of what is resampled
// Of a smoothed edge, in the largest of the spacings. At 1.25, K_M of an ellipsoid went from -16 to
// 0 in place of -6.3 to -4.1, and its run broke down; at 2 from -7.5 to -2.1.
constexpr double mask_width = 2;

std::string names_of_arrays(vtkPointData& data) {
  std::vector<std::string> names;
  for (int a = 0; a < data.GetNumberOfArrays(); ++a)
    if (const char* name = data.GetArrayName(a)) names.push_back(name);
  return names.empty() ? "no named ones" : fmt::format("{}", fmt::join(names, ", "));
}

vtkDataArray& find_phi(vtkImageData& image, const std::string& name) {
  vtkPointData& data = *image.GetPointData();
  if (vtkDataArray* array = data.GetArray(name.c_str())) return *array;
  if (data.GetNumberOfArrays() == 0 && image.GetCellData()->GetNumberOfArrays() > 0)
    throw InputError("the image has cell data only, and point data is needed "
                     "(vtkCellDataToPointData makes it)");
  if (data.GetNumberOfArrays() == 0)
    throw InputError(fmt::format("the image has no point data; a level set \"{}\" is needed, "
                                 "negative inside the membrane",
                                 name));
  if (data.GetNumberOfArrays() > 1 || !data.GetArray(0))
    throw InputError(fmt::format("the image has no point data array \"{}\"; it has {}", name,
                                 names_of_arrays(data)));
  return *data.GetArray(0);
}

std::vector<double> values_of(vtkDataArray& array) {
  const std::string name = array.GetName() ? array.GetName() : "";
  if (array.GetNumberOfComponents() != 1)
    throw InputError(fmt::format("the array \"{}\" has {} components; a field has one", name,
                                 array.GetNumberOfComponents()));
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

std::vector<double> optional_values(vtkImageData& image, const char* name) {
  vtkDataArray* array = image.GetPointData()->GetArray(name);
  return array ? values_of(*array) : std::vector<double>();
}

Lattice lattice_of(vtkImageData& image) {
  Lattice lattice;
  image.GetDimensions(lattice.nodes.data());
  image.GetSpacing(lattice.spacing.data());
  if (image.GetNumberOfPoints() == 0) throw InputError("the image is empty");
  if (*std::ranges::min_element(lattice.nodes) < least_nodes)
    throw InputError(fmt::format("the image has {} nodes; along each axis {} are the least",
                                 fmt::join(lattice.nodes, " x "), least_nodes));
  if (!std::ranges::all_of(lattice.spacing, [](double h) { return h > 0 && std::isfinite(h); }))
    throw InputError(fmt::format("the image has spacings of {:g}; they must be positive",
                                 fmt::join(lattice.spacing, ", ")));
  if (!image.GetDirectionMatrix()->IsIdentity())
    throw InputError("the image is turned; its axes must be x, y and z");
  image.GetPoint(0, lattice.first.data());
  return lattice;
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

Vec3 center_of(const Lattice& lattice, const Grid& grid) {
  return {lattice.first[0] - grid.origin(0), lattice.first[1] - grid.origin(1),
          lattice.first[2] - grid.origin(2)};
}

bool is_mask(const std::vector<double>& values) {
  const auto [low, high] = std::ranges::minmax(values);
  return low < high && std::ranges::all_of(values, [low = low, high = high](double value) {
           return value == low || value == high;
         });
}

/// The level set of a mask, on the grid; adds to the remark.
std::vector<double> phi_of_mask(std::vector<double> mask, const Lattice& lattice, const Grid& grid,
                                std::string& remark) {
  const auto [low, high] = std::ranges::minmax(mask);
  const double inside = low < 0 ? low : high;
  for (double& value : mask) value = value == inside;
  const double width = mask_width * *std::ranges::max_element(lattice.spacing) / grid.spacing;
  mask = from_mask(grid, width, resample(std::move(mask), lattice, Interpolation::linear));
  if (mask.empty())
    throw InputError(
        fmt::format("nothing is left of the inside of the mask, which is smoothed over "
                    "{:.3g} spacings; it must be several of them thick",
                    width));
  remark += fmt::format("{}phi is {:g} or {:g}: taken for a mask, inside where it is {:g}, and "
                        "smoothed over {:.3g} spacings",
                        remark.empty() ? "" : "; ", low, high, inside, width);
  return mask;
}

/// Throws where products of phi and its derivatives would leave the range of numbers.
void check_size(const Frame& frame) {
  constexpr double least = 1e-60, most = 1e60;
  const auto [low, high] = std::ranges::minmax(frame.phi);
  const double largest = std::max(-low, high);
  if (largest > most || (largest > 0 && largest < least))
    throw InputError(fmt::format("phi goes from {:g} to {:g}; it should be about a distance from "
                                 "the membrane",
                                 low, high));
}

/// Throws where phi has no zeros, or some of its inside is at the sides of the box.
void check_closed(const Frame& frame) {
  const auto [least, greatest] = std::ranges::minmax(frame.phi);
  if (!(least < 0 && greatest > 0))
    throw InputError(
        fmt::format("there is no membrane: phi goes from {:g} to {:g}, and is nowhere "
                    "{}; it must be negative inside and positive outside, or a mask of "
                    "two values",
                    least, greatest, least < 0 ? "positive" : "negative"));
  const Grid& grid = frame.grid;
  for (std::size_t n = 0; n < grid.size(); ++n) {
    const std::array<int, 3> at{int(n % grid.nx()), int(n / grid.nx() % grid.ny()),
                                int(n / grid.nx() / grid.ny())};
    for (int a = 0; a < 3; ++a)
      if ((at[a] == 0 || at[a] + 1 == grid.nodes[a]) && frame.phi[n] <= 0)
        throw InputError("the membrane is not closed: phi is not positive everywhere at the sides "
                         "of the image; it must be negative inside, positive outside");
  }
}

void add_array(vtkImageData& image, const char* name, const std::vector<double>& values) {
  if (values.empty()) return;
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(vtkIdType(values.size()));
  std::ranges::copy(values, array->GetPointer(0));
  image.GetPointData()->AddArray(array);
}

} // namespace

ImageVesicle vesicle_in(vtkImageData& image, const std::string& phi_array) {
  const Lattice lattice = lattice_of(image);
  const Grid grid = grid_for(lattice);
  std::vector<double> phi = values_of(find_phi(image, phi_array));
  const auto resampled = [&](std::vector<double> values) {
    return resample(std::move(values), lattice, Interpolation::smooth);
  };
  ImageVesicle vesicle{{.grid = grid,
                        .phi = {},
                        .psi = resampled(optional_values(image, "psi")),
                        .c = resampled(optional_values(image, "c"))},
                       center_of(lattice, grid),
                       remark_on(lattice, grid)};
  vesicle.frame.phi = is_mask(phi) ? phi_of_mask(std::move(phi), lattice, grid, vesicle.remark)
                                   : resampled(std::move(phi));
  if (vtkInformation* about = image.GetInformation(); about->Has(vtkDataObject::DATA_TIME_STEP()))
    vesicle.frame.time = about->Get(vtkDataObject::DATA_TIME_STEP());
  check_size(vesicle.frame);
  check_closed(vesicle.frame);
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
  add_array(image, "psi", frame.psi);
  add_array(image, "c", frame.c);
  image.GetPointData()->SetActiveScalars("phi");
  image.GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), frame.time);
}

} // namespace lamella
