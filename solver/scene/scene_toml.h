#pragma once
#include "scene/scene.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace lamella {

// Scenes as TOML; docs/scene-format.md describes the format. All of these throw SceneError with one
// message:
//   file:line: [section] key: what is wrong; allowed: ...; did you mean "..."?

/// Read and validate a scene file. `overrides` are "section.key=value" with a TOML value or a bare
/// word; they replace what the file says, the last one wins. One of a kind or constraint drops the
/// keys of the file's.
Scene read_scene(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// The same for a text; `source_name` stands for the file in messages, its stem is the default
/// scene name.
Scene parse_scene(std::string_view text, const std::string& source_name,
                  std::span<const std::string> overrides = {});

/// The whole scene with every value that counts, commented; parse_scene gives back an equal scene.
std::string to_toml(const Scene& scene);

/// Parameters in one line, such as "a = 3, b = -2". Throws SceneError.
Parameters parse_parameters(std::string_view text);

/// Material fields from a text such as {name = "m", start = "z", carried = "value"}, several with
/// commas between them. Throws SceneError for what is none.
MaterialFields parse_fields(std::string_view text);
/// And such a text.
std::string text_of(const MaterialFields& fields);

/// All sections and keys as Markdown tables (the reference part of docs/scene-format.md).
std::string describe_keys();

} // namespace lamella
