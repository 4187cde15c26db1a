#include "fields/field_data.h"

#include "fields/start_image.h"
#include "scene/keys.h"
#include "scene/scene_toml.h"

#include <fmt/format.h>

#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkStringArray.h>

namespace lamella {
namespace {

bool has_phases(const Scene& scene) { return scene.has_phases(); }
bool has_one_phase(const Scene& scene) { return !scene.has_phases(); }
bool has_stretch(const Scene& scene) { return scene.stretch.modulus > 0; }
bool has_films(const Scene& scene) { return scene.contact.disjoining_pressure > 0; }

/// Parameters that forces depend on, by how their paths begin, and in which scenes they act.
struct ForceKeys {
  std::string_view begin;
  bool (*act)(const Scene&);
};
constexpr ForceKeys force_keys[] = {
    {"membrane.", has_one_phase},
    {"ld.", has_phases},
    {"lo.", has_phases},
    {"line.", has_phases},
    {"domains.curvature_start_time", has_phases},
    {"stretch.modulus", has_stretch},
    {"contact.disjoining_", has_films},
};

/// Calls with the path, the parameter of the scene if it is a T, and whether it acts there.
template <class T, class Action>
void for_each_parameter(Scene& scene, Action&& action) {
  for (const Key& key : scene_keys()) {
    const std::string path = fmt::format("{}.{}", key.section, key.name);
    for (const ForceKeys& some : force_keys)
      if (path.starts_with(some.begin))
        if (const auto* member = std::get_if<Member<T>>(&key.access))
          action(path, (*member)(scene), some.act(scene));
  }
}

constexpr const char *named_numbers = "parameters", *material_fields_key = "fields";

std::string field_text(vtkDataObject& data, const std::string& name) {
  auto* array = vtkStringArray::SafeDownCast(data.GetFieldData()->GetAbstractArray(name.c_str()));
  return array && array->GetNumberOfValues() == 1 ? std::string(array->GetValue(0)) : "";
}

void set_field_text(vtkDataObject& data, const std::string& name, const std::string& text) {
  if (text.empty()) return;
  vtkNew<vtkStringArray> array;
  array->SetName(name.c_str());
  array->InsertNextValue(text);
  data.GetFieldData()->AddArray(array);
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
  for_each_parameter<double>(copy, [&](const std::string& path, double value, bool acts) {
    if (acts) set_field_value(data, path, value);
  });
  for_each_parameter<std::string>(copy,
                                  [&](const std::string& path, const std::string& text, bool acts) {
                                    if (acts) set_field_text(data, path, text);
                                  });
  set_field_text(data, named_numbers, value_text(*find_key(named_numbers, ""), scene));
  set_field_text(data, material_fields_key, text_of(scene.fields));
}

Scene forces_of(vtkDataObject& data, const Frame& frame, const SurfaceModuli& otherwise) {
  Scene scene = with_start({}, frame.grid, frame.has("psi"));
  scene.membrane = scene.ld = scene.lo = otherwise;
  for_each_parameter<double>(scene, [&](const std::string& path, double& value, bool) {
    value = field_value(data, path).value_or(value);
  });
  for_each_parameter<std::string>(scene, [&](const std::string& path, std::string& text, bool) {
    text = field_text(data, path);
  });
  scene.parameters = parse_parameters(field_text(data, named_numbers));
  scene.fields = parse_fields(field_text(data, material_fields_key));
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
