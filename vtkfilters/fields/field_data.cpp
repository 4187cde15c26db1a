#include "fields/field_data.h"

#include "fields/start_image.h"
#include "scene/keys.h"

#include <fmt/format.h>

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

/// Parameters that forces depend on, by how their paths begin, and in which scenes they act.
struct Parameters {
  std::string_view begin;
  bool (*act)(const Scene&);
};
constexpr Parameters parameters[] = {
    {"membrane.", has_one_phase},
    {"ld.", has_phases},
    {"lo.", has_phases},
    {"line.", has_phases},
    {"domains.curvature_start_time", has_phases},
    {"stretch.modulus", has_stretch},
    {"contact.disjoining_", has_films},
};

/// Calls with the path, the parameter of the scene, and whether it acts there.
template <class Action>
void for_each_parameter(Scene& scene, Action&& action) {
  for (const Key& key : scene_keys()) {
    const std::string path = fmt::format("{}.{}", key.section, key.name);
    for (const Parameters& some : parameters)
      if (path.starts_with(some.begin))
        if (const auto* number = std::get_if<Member<double>>(&key.access))
          action(path, (*number)(scene), some.act(scene));
  }
}

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

void set_forces(vtkDataObject& data, const Scene& scene) {
  Scene copy = scene;
  for_each_parameter(copy, [&](const std::string& path, double value, bool acts) {
    if (acts) set_field_value(data, path, value);
  });
}

Scene forces_of(vtkDataObject& data, const Frame& frame, const SurfaceModuli& otherwise) {
  Scene scene = with_start({}, frame.grid, !frame.psi.empty());
  scene.membrane = scene.ld = scene.lo = otherwise;
  for_each_parameter(scene, [&](const std::string& path, double& value, bool) {
    value = field_value(data, path).value_or(value);
  });
  return scene;
}

std::optional<KnownMultipliers> multipliers_of(vtkDataObject& data, bool has_phases) {
  const auto P = field_value(data, "P"), K_multiplier = field_value(data, "K_multiplier"),
             sigma = field_value(data, has_phases ? "sigma_Lo" : "sigma"),
             sigma_Ld = has_phases ? field_value(data, "sigma_Ld") : 0.0;
  const bool is_one = field_value(data, "vesicles").value_or(1) == 1;
  if (!is_one || !P || !sigma || !K_multiplier || !sigma_Ld) return {};
  return KnownMultipliers{*P, *sigma, *K_multiplier, *sigma_Ld};
}

} // namespace lamella
