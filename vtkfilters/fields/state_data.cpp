#include "fields/state_data.h"

#include "fields/field_data.h"
#include "fields/image.h"
#include "store/history.h"

#include <vtkDoubleArray.h>
#include <vtkNew.h>

#include <string>

namespace lamella {
namespace {

double number_in(const Field& field) {
  if (const auto* real = std::get_if<double*>(&field.value)) return **real;
  return *std::get<int*>(field.value); // measures have no others
}

void add_elasticity(vtkImageData& image, const std::string& section, double bending_modulus,
                    double spontaneous_curvature) {
  set_field_value(image, section + ".bending_modulus", bending_modulus);
  set_field_value(image, section + ".spontaneous_curvature", spontaneous_curvature);
}

} // namespace

void fill_state(vtkImageData& image, const Frame& frame, const Measures& measures,
                const Scene& scene, const Vec3& center) {
  fill_image(image, frame, center);
  Measures copy = measures;
  for (const Field& field : row_of(copy))
    set_field_value(image, std::string(field.column), number_in(field));
  if (!scene.has_phases())
    return add_elasticity(image, "membrane", scene.membrane.bending_modulus,
                          scene.membrane.spontaneous_curvature);
  add_elasticity(image, "ld", scene.ld.bending_modulus, scene.ld.spontaneous_curvature);
  add_elasticity(image, "lo", scene.lo.bending_modulus, scene.lo.spontaneous_curvature);
}

void fill_history(vtkTable& table, std::span<const Measures> history, double until) {
  table.Initialize();
  if (history.empty()) return;
  Measures row = history.front();
  for (const Field& field : row_of(row)) {
    vtkNew<vtkDoubleArray> column;
    column->SetName(std::string(field.column).c_str());
    table.AddColumn(column);
  }
  for (const Measures& measures : history) {
    if (measures.time > until) break;
    row = measures;
    vtkIdType index = 0;
    for (const Field& field : row_of(row))
      vtkDoubleArray::SafeDownCast(table.GetColumn(index++))->InsertNextValue(number_in(field));
  }
}

} // namespace lamella
