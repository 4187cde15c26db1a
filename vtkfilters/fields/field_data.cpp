#include "fields/field_data.h"

#include "fields/start_image.h"

#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>

namespace lamella {
namespace {

bool has_phases(const Scene& scene) { return scene.has_phases(); }
bool has_one_phase(const Scene& scene) { return !scene.has_phases(); }
bool has_stretch(const Scene& scene) { return scene.stretch.modulus > 0; }
bool has_films(const Scene& scene) { return scene.contact.disjoining_pressure > 0; }

/// A parameter that forces depend on: its path, and in which scenes.
struct Parameter {
  const char* path;
  bool (*acts)(const Scene&);
  double& (*of)(Scene&);
};

constexpr Parameter parameters[] = {
    {"membrane.bending_modulus", has_one_phase,
     [](Scene& s) -> double& { return s.membrane.bending_modulus; }},
    {"membrane.spontaneous_curvature", has_one_phase,
     [](Scene& s) -> double& { return s.membrane.spontaneous_curvature; }},
    {"ld.bending_modulus", has_phases, [](Scene& s) -> double& { return s.ld.bending_modulus; }},
    {"ld.spontaneous_curvature", has_phases,
     [](Scene& s) -> double& { return s.ld.spontaneous_curvature; }},
    {"ld.gaussian_modulus", has_phases, [](Scene& s) -> double& { return s.ld.gaussian_modulus; }},
    {"lo.bending_modulus", has_phases, [](Scene& s) -> double& { return s.lo.bending_modulus; }},
    {"lo.spontaneous_curvature", has_phases,
     [](Scene& s) -> double& { return s.lo.spontaneous_curvature; }},
    {"lo.gaussian_modulus", has_phases, [](Scene& s) -> double& { return s.lo.gaussian_modulus; }},
    {"line.tension", has_phases, [](Scene& s) -> double& { return s.line.tension; }},
    {"line.geodesic_modulus", has_phases,
     [](Scene& s) -> double& { return s.line.geodesic_modulus; }},
    {"line.torsion_modulus", has_phases,
     [](Scene& s) -> double& { return s.line.torsion_modulus; }},
    {"line.normal_modulus", has_phases, [](Scene& s) -> double& { return s.line.normal_modulus; }},
    {"line.geodesic_square_modulus", has_phases,
     [](Scene& s) -> double& { return s.line.geodesic_square_modulus; }},
    {"line.torsion_square_modulus", has_phases,
     [](Scene& s) -> double& { return s.line.torsion_square_modulus; }},
    {"line.normal_square_modulus", has_phases,
     [](Scene& s) -> double& { return s.line.normal_square_modulus; }},
    {"domains.curvature_start_time", has_phases,
     [](Scene& s) -> double& { return s.curvature_start_time; }},
    {"stretch.modulus", has_stretch, [](Scene& s) -> double& { return s.stretch.modulus; }},
    {"contact.disjoining_pressure", has_films,
     [](Scene& s) -> double& { return s.contact.disjoining_pressure; }},
    {"contact.disjoining_range", has_films,
     [](Scene& s) -> double& { return s.contact.disjoining_range; }},
};

} // namespace

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

void set_forces(vtkDataObject& data, const Scene& scene) {
  Scene copy = scene;
  for (const Parameter& parameter : parameters)
    if (parameter.acts(scene)) set_field_value(data, parameter.path, parameter.of(copy));
}

Scene forces_of(vtkDataObject& data, const Frame& frame) {
  Scene scene = with_start({}, frame.grid, !frame.psi.empty());
  for (const Parameter& parameter : parameters)
    if (const auto value = field_value(data, parameter.path)) parameter.of(scene) = *value;
  return scene;
}

std::optional<KnownMultipliers> multipliers_of(vtkDataObject& data, bool has_phases) {
  const auto P = field_value(data, "P"), K_multiplier = field_value(data, "K_multiplier"),
             sigma = field_value(data, has_phases ? "sigma_Lo" : "sigma"),
             sigma_Ld = has_phases ? field_value(data, "sigma_Ld") : 0.0;
  if (!P || !sigma || !K_multiplier || !sigma_Ld) return {};
  return KnownMultipliers{*P, *sigma, *K_multiplier, *sigma_Ld};
}

} // namespace lamella
