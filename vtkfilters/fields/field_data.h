#pragma once
#include "energy/helfrich.h"

#include <vtkDataObject.h>

#include <array>
#include <optional>
#include <string>

namespace lamella {

/// Field data of one number: parameters of a scene by their path ("membrane.bending_modulus"),
/// measures of a state by their column in the history ("sigma").
std::optional<double> field_value(vtkDataObject& data, const std::string& name);
void set_field_value(vtkDataObject& data, const std::string& name, double value);

/// The bending energy of a membrane, phase by phase.
struct Elasticity {
  Helfrich membrane, ld, lo; ///< of one with a single phase; of those of one with two

  const Helfrich& at(double psi) const { return psi < 0 ? ld : lo; }
};

/// What the field data says; the given one where it says nothing.
Elasticity elasticity_of(vtkDataObject& data, const Helfrich& otherwise);

/// Multipliers of 1, K_M and K in the normal velocity; none where the field data does not have
/// them.
std::optional<std::array<double, 3>> multipliers_of(vtkDataObject& data);

} // namespace lamella
