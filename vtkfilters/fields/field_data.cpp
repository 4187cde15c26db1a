#include "fields/field_data.h"

#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>

namespace lamella {

std::optional<double> field_value(vtkDataObject& data, const std::string& name) {
  vtkDataArray* array = data.GetFieldData()->GetArray(name.c_str());
  if (!array || array->GetNumberOfValues() != 1) return {};
  return array->GetComponent(0, 0);
}

void set_field_value(vtkDataObject& data, const std::string& name, double value) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name.c_str());
  array->InsertNextValue(value);
  data.GetFieldData()->AddArray(array);
}

Elasticity elasticity_of(vtkDataObject& data, const Helfrich& otherwise) {
  const auto of = [&](const std::string& section) -> Helfrich {
    return {field_value(data, section + ".bending_modulus").value_or(otherwise.bending_modulus),
            field_value(data, section + ".spontaneous_curvature")
                .value_or(otherwise.spontaneous_curvature)};
  };
  return {of("membrane"), of("ld"), of("lo")};
}

std::optional<std::array<double, 3>> multipliers_of(vtkDataObject& data) {
  const auto P = field_value(data, "P"), sigma = field_value(data, "sigma"),
             K_multiplier = field_value(data, "K_multiplier");
  if (!P || !sigma || !K_multiplier) return {};
  return std::array{*P, *sigma, *K_multiplier};
}

} // namespace lamella
