#pragma once
#include "scene/keys.h"
#include "scene/scene.h"

#include <map>
#include <ostream>
#include <span>
#include <string>
#include <string_view>

namespace lamella {

/// The scene that properties make. A choice may be set to a name that there is not, as a number may
/// be out of its range; that is refused where the scene is used.
struct PropertyScene : Scene {
  std::map<const Key*, std::string> unknown; ///< such names
  std::string parameters_text, fields_text;  ///< as they were set
};

/// The value by name of a parameter that has a choice, such as kind in [shape].
const char* choice_of(const PropertyScene& scene, std::string_view section, std::string_view key);
/// Whether that changed anything.
bool set_choice(PropertyScene& scene, const Key& key, std::string_view value);
/// Parameters as "a = 3, b = -2", fields as "{name = "m", start = "z"}"; whether that changed
/// anything.
bool set_parameters(PropertyScene& scene, std::string_view text);
bool set_fields(PropertyScene& scene, std::string_view text);
/// Throws InputError for a name that there is not, with those there are, and SceneError for
/// parameters that are no numbers and fields that are none.
void check_choices(const PropertyScene& scene);

/// The parameters of some sections that count, a line each.
void print_sections(std::ostream& out, const std::string& indent, const Scene& scene,
                    std::span<const std::string_view> sections);

/// The next value of a ramp, and when to set out for it; or none any more.
void add_target(Ramp& ramp, double target, double start_time);
void remove_targets(Ramp& ramp);

} // namespace lamella

// Definitions of VTK properties that are members of this->Scene.

#define lamellaProperty(cls, name, type, member)                                                   \
  void cls::Set##name(type value) {                                                                \
    if (this->Scene->member == value) return;                                                      \
    this->Scene->member = value;                                                                   \
    this->Modified();                                                                              \
  }                                                                                                \
  type cls::Get##name() { return this->Scene->member; }

#define lamellaVectorProperty(cls, name, type, member)                                             \
  void cls::Set##name(type x, type y, type z) {                                                    \
    const std::array<type, 3> value{x, y, z};                                                      \
    if (this->Scene->member == value) return;                                                      \
    this->Scene->member = value;                                                                   \
    this->Modified();                                                                              \
  }                                                                                                \
  type* cls::Get##name() { return this->Scene->member.data(); }

#define lamellaChoiceProperty(cls, name, section, key)                                             \
  void cls::Set##name(const char* value) {                                                         \
    const lamella::Key& choice = *lamella::find_key(section, key);                                 \
    if (lamella::set_choice(*this->Scene, choice, value ? value : "")) this->Modified();           \
  }                                                                                                \
  const char* cls::Get##name() { return lamella::choice_of(*this->Scene, section, key); }

#define lamellaTextProperty(cls, name, member)                                                     \
  void cls::Set##name(const char* value) {                                                         \
    const std::string text(value ? value : "");                                                    \
    if (this->Scene->member == text) return;                                                       \
    this->Scene->member = text;                                                                    \
    this->Modified();                                                                              \
  }                                                                                                \
  const char* cls::Get##name() { return this->Scene->member.c_str(); }

#define lamellaRampProperty(cls, name, member)                                                     \
  void cls::Add##name##Target(double target, double start_time) {                                  \
    lamella::add_target(this->Scene->member, target, start_time);                                  \
    this->Modified();                                                                              \
  }                                                                                                \
  void cls::RemoveAll##name##Targets() {                                                           \
    if (this->Scene->member.targets.empty()) return;                                               \
    lamella::remove_targets(this->Scene->member);                                                  \
    this->Modified();                                                                              \
  }                                                                                                \
  int cls::GetNumberOf##name##Targets() {                                                          \
    return static_cast<int>(this->Scene->member.targets.size());                                   \
  }
