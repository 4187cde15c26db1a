#include "commands.h"

#include "exit_code.h"
#include "interrupt.h"
#include "progress.h"
#include "scene/builtin.h"

#include <fmt/format.h>

namespace lamella {

int show_scenes(const std::string& name) {
  end_at_interrupt();
  if (name.empty()) {
    for (const BuiltinScene& scene : builtin_scenes())
      say(fmt::format("{:<16} {}\n", scene.name, scene.title));
    return success;
  }
  builtin_scene(name);
  for (const BuiltinScene& scene : builtin_scenes())
    if (scene.name == name) say(std::string(scene.text));
  return success;
}

} // namespace lamella
