// Scenes of any bytes: parsed, or refused with one line.
#include "error.h"
#include "fuzz.h"
#include "scene/builtin.h"
#include "scene/scene_toml.h"

namespace lamella::fuzz {

std::vector<std::string> seeds() {
  std::vector<std::string> texts;
  for (const BuiltinScene& scene : builtin_scenes()) texts.emplace_back(scene.text);
  return texts;
}

} // namespace lamella::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lamella;
  try {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const Scene scene = parse_scene(text, "fuzz.toml");
    fuzz::expect(to_toml(parse_scene(to_toml(scene), "again.toml")) == to_toml(scene),
                 "a scene is not what was written of it");
  } catch (const SceneError& e) {
    const std::string_view message = e.what();
    fuzz::expect(!message.empty() && message.find('\n') == message.npos, "not one line");
  }
  return 0;
}
