#include "scene/scene_toml.h"

#include "nearest.h"
#include "scene/document.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace lamella {
namespace {

std::string described(const toml::node& value) {
  if (const auto* text = value.as_string())
    return fmt::format("the text \"{}\"", shortened(text->get()));
  if (const auto* integer = value.as_integer())
    return fmt::format("the integer {}", integer->get());
  if (const auto* number = value.as_floating_point())
    return fmt::format("the number {}", number->get());
  if (const auto* boolean = value.as_boolean()) return boolean->get() ? "true" : "false";
  if (const auto* list = value.as_array()) return fmt::format("a list of {}", list->size());
  return value.is_table() ? "a section" : "a date or time";
}

// assign: give a member its value, or return false because the value's type does not fit.

bool assign(double& member, const toml::node& value) {
  if (!value.is_number()) return false;
  member = *value.value<double>();
  return true;
}

bool assign(int& member, const toml::node& value) {
  if (!value.is_integer()) return false;
  constexpr std::int64_t limit = std::numeric_limits<int>::max();
  member = static_cast<int>(std::clamp(value.as_integer()->get(), -limit, limit));
  return true;
}

bool assign(bool& member, const toml::node& value) {
  if (!value.is_boolean()) return false;
  member = value.as_boolean()->get();
  return true;
}

bool assign(std::string& member, const toml::node& value) {
  if (!value.is_string()) return false;
  member = value.as_string()->get();
  return true;
}

template <class T>
bool assign(std::array<T, 3>& member, const toml::node& value) {
  const toml::array* list = value.as_array();
  if (!list || list->size() != 3) return false;
  for (std::size_t i = 0; i < 3; ++i)
    if (!assign(member[i], *list->get(i))) return false;
  return true;
}

bool assign(std::vector<double>& member, const toml::node& value) {
  const toml::array* list = value.as_array();
  member.resize(list ? list->size() : 1);
  if (!list) return assign(member.front(), value);
  for (std::size_t i = 0; i < member.size(); ++i)
    if (!assign(member[i], *list->get(i))) return false;
  return true;
}

bool assign(std::vector<Vec3>& member, const toml::node& value) {
  const toml::array* list = value.as_array();
  member.resize(list ? list->size() : 0);
  for (std::size_t i = 0; i < member.size(); ++i)
    if (!assign(member[i], *list->get(i))) return false;
  return list != nullptr;
}

bool assign_nodes(std::array<int, 3>& nodes, const toml::node& value) {
  int all = 0;
  if (!assign(all, value)) return assign(nodes, value);
  nodes.fill(all);
  return true;
}

/// One value taken from its TOML node into the scene, or refused.
class Assignment {
public:
  Assignment(Scene& scene, const Given& given) : scene_(scene), given_(given) {
    std::visit(*this, given.key->access);
  }

  template <class T>
  void operator()(Member<T> member) const {
    if (!assign(member(scene_), *given_.value)) refuse("does not fit");
  }

  void operator()(Member<std::array<int, 3>> member) const {
    if (!assign_nodes(member(scene_), *given_.value)) refuse("does not fit");
  }

  void operator()(Member<Parameters> member) const {
    if (!assign(member(scene_)[given_.name], *given_.value)) refuse("does not fit");
  }

  void operator()(Member<MaterialFields> member) const {
    const toml::array* list = given_.value->as_array();
    if (!list) refuse("does not fit");
    MaterialFields& fields = member(scene_);
    fields.clear();
    for (const toml::node& entry : *list) {
      if (!entry.is_table()) refuse("does not fit");
      fields.push_back(field_of(*entry.as_table(), fields.size() + 1));
    }
  }

  void operator()(const Choice& choice) const {
    const auto* text = given_.value->as_string();
    if (!text) refuse("does not fit");
    const auto name = std::ranges::find(choice.names, text->get());
    if (name == choice.names.end())
      refuse("is not available in this release", suggestion(text->get(), choice.names));
    choice.set(scene_, static_cast<int>(name - choice.names.begin()));
  }

private:
  MaterialField field_of(const toml::table& table, std::size_t number) const {
    MaterialField field;
    for (const auto& [key, value] : table) {
      const auto refuse = [&, &key = key, &value = value](std::string_view allowed) {
        refuse_scene(fmt::format("{}[[fields]] {} of field {}: {} does not fit; allowed: {}",
                                 given_.place, shortened(key.str()), number, described(value),
                                 allowed));
      };
      if (key == "name") {
        if (!assign(field.name, value)) refuse("a text in quotes");
      } else if (key == "start") {
        if (!assign(field.start, value)) refuse("a text in quotes");
      } else if (key == "carried") {
        std::string carried;
        if (!assign(carried, value) || (carried != "value" && carried != "amount"))
          refuse("\"value\", \"amount\"");
        field.carried = carried == "value" ? Carried::value : Carried::amount;
      } else {
        constexpr std::string_view names[]{"name", "start", "carried"};
        refuse_scene(fmt::format("{}[[fields]] {}: unknown key; allowed: {}{}", given_.place,
                                 shortened(key.str()), fmt::join(names, ", "),
                                 suggestion(key.str(), names)));
      }
    }
    return field;
  }

  [[noreturn]] void refuse(std::string_view what, const std::string& hint = {}) const {
    const std::string label = given_.key->name.empty() ? fmt::format("[{}] {}", given_.key->section,
                                                                     shortened(given_.name))
                                                       : given_.key->label();
    refuse_scene(fmt::format("{}{}: {} {}; allowed: {}{}", given_.place, label,
                             described(*given_.value), what, allowed_text(*given_.key), hint));
  }

  Scene& scene_;
  const Given& given_;
};

/// What is chosen where there is a choice, such as the kind of shape; all else is at its default.
Scene choices(const std::vector<Given>& given) {
  Scene scene;
  for (const Given& g : given)
    if (g.key == &choice_key(g.key->section)) Assignment(scene, g);
  return scene;
}

/// What to use instead of a key that does not count: others of its section or, where none does, the
/// sections that count as a whole.
std::vector<std::string> replacements(const Key& unwanted, const Scene& scene) {
  std::vector<std::string> names;
  for (const Key& key : scene_keys())
    if (key.section == unwanted.section && key.counts_in(scene)) names.emplace_back(key.name);
  if (!names.empty()) return names;
  for (const std::string_view section : scene_sections()) {
    const Key& first = *find_key(section, keys_of_section(section).front());
    if (!first.cases.empty() && first.counts_in(scene))
      names.push_back(fmt::format("[{}]", section));
  }
  return names;
}

void refuse_keys_that_do_not_count(const std::vector<Given>& given) {
  const Scene scene = choices(given);
  for (const Given& g : given) {
    if (g.key->counts_in(scene)) continue;
    const Key& choice = choice_key(g.key->section);
    refuse_scene(
        fmt::format("{}{}: belongs to {} = \"{}\", not {}; allowed: {}", g.place, g.key->label(),
                    choice.section == g.key->section ? std::string(choice.name) : choice.label(),
                    fmt::join(g.key->cases, "\" or \""), value_text(choice, scene),
                    fmt::join(replacements(*g.key, scene), ", ")));
  }
}

/// The file's keys followed by the overrides; where these choose otherwise than the file, without
/// the keys that no longer count.
std::vector<Given> merged(std::vector<Given> given, std::span<const std::string> overrides) {
  refuse_keys_that_do_not_count(given);
  for (const std::string& argument : overrides) given.push_back(parse_override(argument));
  const Scene scene = choices(given);
  std::erase_if(given, [&](const Given& g) { return !g.is_override && !g.key->counts_in(scene); });
  refuse_keys_that_do_not_count(given);
  return given;
}

/// Names an override before a line of the file, and a line before what was left at its default.
KeyLocator locator(const std::vector<Given>& given, const std::string& source) {
  return [&given, source](std::span<const std::string_view> keys) -> KeyPlace {
    for (const bool want_override : {true, false})
      for (const auto key : keys)
        for (auto g = given.rbegin(); g != given.rend(); ++g)
          if (g->is_override == want_override && g->path() == key) return {key, g->place};
    return {keys.front(), source + ": "};
  };
}

/// Lines of a scene that give a key; none for a key of any name that is given no number.
std::vector<std::string> settings(const Key& key, const Scene& scene) {
  if (!key.name.empty()) return {fmt::format("{} = {}", key.name, value_text(key, scene))};
  std::vector<std::string> lines;
  for (const auto& [name, number] : scene.parameters)
    lines.push_back(fmt::format("{} = {}", name, number));
  return lines;
}

std::string unit_note(const Key& key) {
  return key.unit.empty() ? std::string() : fmt::format(" ({})", key.unit);
}

} // namespace

Scene read_scene(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return parse_scene(read_text(file), file.string(), overrides);
}

Scene parse_scene(std::string_view text, const std::string& source_name,
                  std::span<const std::string> overrides) {
  const std::vector<Given> given = merged(parse_document(text, source_name), overrides);
  Scene scene;
  scene.name = std::filesystem::path(source_name).stem().string();
  for (const Given& g : given) Assignment(scene, g);
  validate(scene, locator(given, source_name));
  return scene;
}

Parameters parse_parameters(std::string_view text) {
  const std::string what = fmt::format("[parameters]: \"{}\"", shortened(text));
  Parameters numbers;
  const toml::table table = parse_toml(fmt::format("all = {{{}}}", text), what);
  if (table.size() > 1)
    refuse_scene(what + ": not numbers; allowed: numbers such as a = 3, b = -2");
  for (const auto& [name, value] : *table["all"].as_table()) {
    if (!value.is_number())
      refuse_scene(fmt::format("{}: {} is no number; allowed: numbers such as a = 3, b = -2", what,
                               shortened(name.str())));
    numbers[std::string(name.str())] = *value.value<double>();
  }
  return numbers;
}

MaterialFields parse_fields(std::string_view text) {
  const std::string what = fmt::format("fields: \"{}\"", shortened(text));
  const auto table =
      std::make_shared<const toml::table>(parse_toml(fmt::format("fields = [{}]", text), what));
  if (table->size() > 1)
    refuse_scene(what + ": no fields; allowed: such as {name = \"m\", start = \"z\"}");
  const Given given{find_key("", "fields"), "fields", {table, table->get("fields")}, "", false};
  Scene scene;
  Assignment(scene, given);
  return scene.fields;
}

std::string text_of(const MaterialFields& fields) {
  Scene scene;
  scene.fields = fields;
  const std::string list = value_text(*find_key("", "fields"), scene); // in brackets
  return list.substr(1, list.size() - 2);
}

std::string to_toml(const Scene& scene) {
  std::string text;
  std::string_view section;
  for (const Key& key : scene_keys()) {
    if (!key.counts_in(scene)) continue;
    const std::vector<std::string> lines = settings(key, scene);
    if (key.section != section && !lines.empty())
      text += fmt::format("\n[{}]\n", section = key.section);
    for (const std::string& setting : lines)
      text += fmt::format("{:<36} # {}{}\n", setting, key.help, unit_note(key));
  }
  return text;
}

std::string describe_keys() {
  std::string text;
  for (const std::string_view section : scene_sections()) {
    text += section.empty() ? "### Before the first section\n\n"
                            : fmt::format("\n### [{}]\n\n", section);
    const Key& first = *find_key(section, keys_of_section(section).front());
    if (!first.cases.empty())
      text += fmt::format("With {} = \"{}\":\n\n", choice_key(section).label(),
                          fmt::join(first.cases, "\" or \""));
    text += "| key | allowed | unit | default | meaning |\n|---|---|---|---|---|\n";
    for (const Key& key : scene_keys()) {
      if (key.section != section) continue;
      const std::string of_case =
          key.cases == first.cases ? "" : fmt::format("{}: ", fmt::join(key.cases, ", "));
      const std::string fallback = key.fallback.empty()
                                       ? fmt::format("`{}`", value_text(key, Scene{}))
                                       : std::string(key.fallback);
      const std::string name = key.name.empty() ? "any name" : fmt::format("`{}`", key.name);
      text += fmt::format("| {} | {} | {} | {} | {}{} |\n", name, allowed_text(key), key.unit,
                          fallback, of_case, key.help);
    }
  }
  return text;
}

} // namespace lamella
