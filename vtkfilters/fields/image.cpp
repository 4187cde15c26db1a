#include "fields/image.h"

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

constexpr int least_nodes = 8;          // along an axis: what a spline needs
constexpr double equal_spacings = 1e-6; // relative

std::string names_of_arrays(vtkPointData& data) {
  std::vector<std::string> names;
  for (int a = 0; a < data.GetNumberOfArrays(); ++a)
    if (const char* name = data.GetArrayName(a)) names.push_back(name);
  return names.empty() ? "no named ones" : fmt::format("{}", fmt::join(names, ", "));
}

vtkDataArray& find_phi(vtkImageData& image, const std::string& name) {
  vtkPointData& data = *image.GetPointData();
  if (vtkDataArray* array = data.GetArray(name.c_str())) return *array;
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
  std::vector<double> values(array.GetNumberOfTuples());
  if (auto* doubles = vtkDoubleArray::SafeDownCast(&array))
    std::copy_n(doubles->GetPointer(0), values.size(), values.begin());
  else
    for (std::size_t n = 0; n < values.size(); ++n) values[n] = array.GetComponent(vtkIdType(n), 0);
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

Grid grid_of(vtkImageData& image) {
  Grid grid;
  const double* spacing = image.GetSpacing();
  image.GetDimensions(grid.nodes.data());
  if (image.GetNumberOfPoints() == 0) throw InputError("the image is empty");
  if (*std::ranges::min_element(grid.nodes) < least_nodes)
    throw InputError(fmt::format("the image has {} nodes; along each axis {} are the least",
                                 fmt::join(grid.nodes, " x "), least_nodes));
  grid.spacing = spacing[0];
  if (!(grid.spacing > 0) || !(std::abs(spacing[1] / grid.spacing - 1) < equal_spacings) ||
      !(std::abs(spacing[2] / grid.spacing - 1) < equal_spacings))
    throw InputError(fmt::format("the image has spacings of {:g}, {:g} and {:g}; they must be "
                                 "positive and equal (vtkImageResample makes them so)",
                                 spacing[0], spacing[1], spacing[2]));
  if (!image.GetDirectionMatrix()->IsIdentity())
    throw InputError("the image is turned; its axes must be x, y and z");
  return grid;
}

Vec3 center_of(vtkImageData& image, const Grid& grid) {
  Vec3 first;
  image.GetPoint(0, first.data());
  return {first[0] - grid.origin(0), first[1] - grid.origin(1), first[2] - grid.origin(2)};
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
    throw InputError(fmt::format("there is no membrane: phi goes from {:g} to {:g}, and is nowhere "
                                 "{}; it must be negative inside, positive outside",
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
  const Grid grid = grid_of(image);
  ImageVesicle vesicle{{.grid = grid,
                        .phi = values_of(find_phi(image, phi_array)),
                        .psi = optional_values(image, "psi"),
                        .c = optional_values(image, "c")},
                       center_of(image, grid)};
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
