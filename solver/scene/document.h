#pragma once
#include "scene/keys.h"

#include <toml++/toml.h>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace lamella {

/// One key as a scene or --set gives it.
struct Given {
  const Key* key;
  std::string name; ///< as it is given: the key's own, or any where the key has none
  std::shared_ptr<const toml::node> value;
  std::string place; ///< as messages begin: "file:12: "
  bool is_override;

  std::string path() const; ///< as Key::path, with the name given
};

/// A scene's text, at most 1 MiB. Throws SceneError.
std::string read_text(const std::filesystem::path& file);

/// A text as TOML. Throws SceneError for one that is not TOML, or that could not be of ours.
toml::table parse_toml(std::string_view text, const std::string& source);

/// The keys of a scene in the order of its lines. Throws SceneError for a text that is not TOML,
/// for unknown sections and keys, and if there is none.
std::vector<Given> parse_document(std::string_view text, const std::string& source);

/// "section.key=value" of --set. What is no TOML value counts as a text. Throws SceneError.
Given parse_override(const std::string& argument);

/// Throw a SceneError of one printable line of bounded length, whatever the scene had in it.
[[noreturn]] void refuse_scene(std::string message);

/// Cut to what a message can hold.
std::string shortened(std::string_view text);

} // namespace lamella
