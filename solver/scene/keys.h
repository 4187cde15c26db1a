#pragma once
#include "scene/scene.h"

#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace lamella {

/// How to reach a member of a Scene.
template <class T>
using Member = T& (*)(Scene&);

/// A member whose values have names.
struct Choice {
  std::vector<std::string_view> names; ///< in the order of the enumerators
  int (*get)(Scene&);
  void (*set)(Scene&, int);
};

using Access =
    std::variant<Member<double>, Member<int>, Member<bool>, Member<std::string>, Member<Vec3>,
                 Member<std::array<int, 3>>, Member<std::vector<double>>, Member<std::vector<Vec3>>,
                 Member<Parameters>, Member<MaterialFields>, Choice>;

/// Allowed numbers, for vectors and lists each of them. What is not finite is never allowed.
struct Range {
  double low = -1e30, high = 1e30;
  bool above_low = false;  ///< low itself is not allowed
  bool below_high = false; ///< high itself is not allowed
  int multiple_of = 0;     ///< 0: any

  bool contains(double x) const;
  bool divides(double x) const { return multiple_of == 0 || std::remainder(x, multiple_of) == 0; }
};

/// One parameter of a scene: all that reading, writing, checking and documenting it needs.
struct Key {
  std::string_view section, name; ///< no name: the section's keys have any
  Access access;
  std::string_view unit;
  Range range;
  /// The values of choice_key(section) for which it counts; empty: it always does.
  std::vector<std::string_view> cases;
  std::string_view help;
  std::string_view fallback = {}; ///< the default in words, where the plain value says too little

  std::string path() const;  ///< shape.semi_axis, as in --set
  std::string label() const; ///< [shape] semi_axis, as in messages
  bool counts_in(Scene scene) const;
};

/// Every key of the scene format, in the order in which scenes are written.
std::span<const Key> scene_keys();

/// The sections, in order; "" holds the keys before the first section.
std::vector<std::string_view> scene_sections();
std::vector<std::string_view> keys_of_section(std::string_view section);

/// The key of this name, or the one for any name; null for an unknown key.
const Key* find_key(std::string_view section, std::string_view name);

/// The key whose value decides which keys of a section count, if not all do: one of its own, such
/// as kind in [shape], or else kind in [domains].
const Key& choice_key(std::string_view section);

/// A value of a scene in TOML.
std::string value_text(const Key& key, Scene scene);

/// What a key accepts, in words: "an integer multiple of 8 from 16 to 512".
std::string allowed_text(const Key& key);

/// `text` as a TOML string.
std::string quoted(std::string_view text);

} // namespace lamella
