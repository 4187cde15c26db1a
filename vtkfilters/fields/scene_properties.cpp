#include "fields/scene_properties.h"

#include "fields/image.h"
#include "scene/keys.h"
#include "scene/nearest.h"

#include <fmt/format.h>

#include <algorithm>

namespace lamella {

const char* choice_of(const Scene& scene, std::string_view section, std::string_view key) {
  const Choice& choice = std::get<Choice>(find_key(section, key)->access);
  Scene copy = scene;
  return choice.names[choice.get(copy)].data(); // a literal
}

bool set_choice(Scene& scene, std::string_view section, std::string_view name,
                std::string_view value) {
  const Key& key = *find_key(section, name);
  const Choice& choice = std::get<Choice>(key.access);
  const auto found = std::ranges::find(choice.names, value);
  if (found == choice.names.end())
    throw InputError(fmt::format("{}: \"{}\" is not available; allowed: {}{}", key.label(), value,
                                 allowed_text(key), suggestion(std::string(value), choice.names)));
  const int index = int(found - choice.names.begin());
  if (choice.get(scene) == index) return false;
  choice.set(scene, index);
  return true;
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
