#include "fields/scene_properties.h"

#include "error.h"
#include "fields/image.h"
#include "nearest.h"
#include "scene/scene_toml.h"

#include <fmt/format.h>

#include <algorithm>

namespace lamella {

const char* choice_of(const PropertyScene& scene, std::string_view section, std::string_view key) {
  const Key* found = find_key(section, key);
  if (const auto name = scene.unknown.find(found); name != scene.unknown.end())
    return name->second.c_str();
  const Choice& choice = std::get<Choice>(found->access);
  Scene copy = scene;
  return choice.names[choice.get(copy)].data(); // a literal
}

bool set_choice(PropertyScene& scene, const Key& key, std::string_view value) {
  if (value == choice_of(scene, key.section, key.name)) return false;
  const Choice& choice = std::get<Choice>(key.access);
  const auto found = std::ranges::find(choice.names, value);
  if (found == choice.names.end()) {
    scene.unknown[&key] = value;
  } else {
    scene.unknown.erase(&key);
    choice.set(scene, int(found - choice.names.begin()));
  }
  return true;
}

bool set_parameters(PropertyScene& scene, std::string_view text) {
  if (text == scene.parameters_text) return false;
  scene.parameters_text = text;
  try {
    scene.parameters = parse_parameters(text);
  } catch (const SceneError&) { // refused where they are used
    scene.parameters.clear();
  }
  return true;
}

bool set_fields(PropertyScene& scene, std::string_view text) {
  if (text == scene.fields_text) return false;
  scene.fields_text = text;
  try {
    scene.fields = parse_fields(text);
  } catch (const SceneError&) { // refused where they are used
    scene.fields.clear();
  }
  return true;
}

void check_choices(const PropertyScene& scene) {
  parse_parameters(scene.parameters_text);
  parse_fields(scene.fields_text);
  for (const auto& [key, value] : scene.unknown)
    throw InputError(fmt::format("{}: \"{}\" is not available; allowed: {}{}", key->label(), value,
                                 allowed_text(*key),
                                 suggestion(value, std::get<Choice>(key->access).names)));
}

void print_sections(std::ostream& out, const std::string& indent, const Scene& scene,
                    std::span<const std::string_view> sections) {
  for (const Key& key : scene_keys())
    if (std::ranges::find(sections, key.section) != sections.end() && key.counts_in(scene))
      out << indent << key.label() << " = " << value_text(key, scene) << "\n";
}

void add_target(Ramp& ramp, double target, double start_time) {
  if (ramp.targets.empty()) ramp.start_times.clear();
  ramp.targets.push_back(target);
  ramp.start_times.push_back(start_time);
}

void remove_targets(Ramp& ramp) {
  ramp.targets.clear();
  ramp.start_times = Ramp{}.start_times;
}

} // namespace lamella
