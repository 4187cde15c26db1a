#pragma once
#include "fields/velocity.h"
#include "scene/scene.h"
#include "store/frame.h"

#include <vtkDataObject.h>

#include <optional>
#include <string>

namespace lamella {

/// Field data of one number or text: parameters of a scene by their path
/// ("membrane.bending_modulus"), measures of a state by their column in the history ("sigma").
std::optional<double> field_value(vtkDataObject& data, const std::string& name);
void set_field_value(vtkDataObject& data, const std::string& name, double value);

/// Writes the parameters of a scene that its forces depend on, those that act; and reads them
/// again, into a scene that has the grid and phases of a frame, with the given moduli where the
/// field data says nothing. Throws SceneError for named numbers that are none.
void set_forces(vtkDataObject& data, const Scene& scene);
Scene forces_of(vtkDataObject& data, const Frame& frame, const SurfaceModuli& otherwise);

/// Multipliers in the normal velocity of a membrane; nothing where the field data does not have all
/// of them, or several vesicles have their own.
std::optional<KnownMultipliers> multipliers_of(vtkDataObject& data, bool has_phases);

} // namespace lamella
