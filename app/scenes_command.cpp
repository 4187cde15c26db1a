#include "commands.h"

#include "exit_code.h"
#include "scene/builtin.h"

#include <fmt/format.h>

namespace lamella {

int show_scenes(const std::string& name) {
  if (name.empty()) {
    for (const BuiltinScene& scene : builtin_scenes())
      fmt::print("{:<16} {}\n", scene.name, scene.title);
    return success;
  }
  builtin_scene(name);
  for (const BuiltinScene& scene : builtin_scenes())
    if (scene.name == name) fmt::print("{}", scene.text);
  return success;
}

} // namespace lamella
