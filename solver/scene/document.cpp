#include "scene/document.h"

#include "error.h"
#include "nearest.h"
#include "regular_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace lamella {
namespace {

constexpr std::size_t largest_text = 1 << 20; // bytes
constexpr int most_dots_in_a_line = 24;

std::string at_line(const std::string& source, std::size_t line) {
  return fmt::format("{}:{}: ", source, line);
}

/// The dot of a number such as -1.25e3; a dot of a key 1.25.3 is not taken for one.
bool is_decimal_point(std::string_view text, std::size_t dot) {
  auto is_digit = [&](std::size_t i) { return text[i] >= '0' && text[i] <= '9'; };
  std::size_t begin = dot, end = dot + 1;
  while (begin > 0 && is_digit(begin - 1)) begin--;
  while (end < text.size() && is_digit(end)) end++;
  constexpr std::string_view before = "=[,+- \t", after = ",]}eE \t\r\n";
  return begin < dot && begin > 0 && before.find(text[begin - 1]) != before.npos &&
         (end == text.size() || after.find(text[end]) != after.npos);
}

/// Refuse what the parser is not to see: it recurses once for every level of nesting.
void refuse_rubbish(std::string_view text, const std::string& source) {
  if (text.size() > largest_text)
    refuse_scene(source + ": larger than 1 MiB; allowed: a scene, which is a short text");
  std::size_t line = 1;
  bool is_blank = true, is_comment = false;
  int dots = 0;
  for (std::size_t i = 0; i < text.size(); i++) {
    const char c = text[i];
    if (c == '\0') refuse_scene(at_line(source, line) + "not a text; allowed: a scene in TOML");
    if (c == '\n') {
      ++line;
      is_blank = true, is_comment = false, dots = 0;
      continue;
    }
    if (is_blank && c == '#') is_comment = true;
    is_blank = is_blank && (c == ' ' || c == '\t');
    if (c == '.' && !is_comment && !is_decimal_point(text, i) && ++dots > most_dots_in_a_line)
      refuse_scene(at_line(source, line) +
                   "nested too deeply; allowed: sections that hold plain keys");
  }
}

bool is_section(std::string_view name) { return !name.empty() && !keys_of_section(name).empty(); }

/// The known section that has a key of this name, or nothing.
std::string_view home_of(std::string_view name) {
  for (const Key& key : scene_keys())
    if (key.name == name) return key.section;
  return {};
}

[[noreturn]] void refuse_section(const std::string& place, std::string_view name) {
  std::vector<std::string_view> sections = scene_sections();
  std::erase(sections, "");
  refuse_scene(fmt::format("{}[{}]: unknown section; allowed: [{}]{}", place, shortened(name),
                           fmt::join(sections, "], ["), suggestion(name, sections)));
}

[[noreturn]] void refuse_key(const std::string& place, std::string_view section,
                             std::string_view name) {
  const auto siblings = keys_of_section(section);
  const std::string_view home = home_of(name);
  const std::string hint = home.empty() ? suggestion(name, siblings)
                                        : fmt::format("; did you mean {} in [{}]?", name, home);
  const std::string label = section.empty() ? "" : fmt::format("[{}] ", section);
  refuse_scene(fmt::format("{}{}{}: unknown key; allowed: {}{}", place, label, shortened(name),
                           fmt::join(siblings, ", "), hint));
}

const Key& known_key(const std::string& place, std::string_view section, std::string_view name) {
  if (!section.empty() && !is_section(section)) refuse_section(place, section);
  const Key* key = find_key(section, name);
  if (!key) refuse_key(place, section, name);
  return *key;
}

bool takes_text(const Key& key) {
  return std::holds_alternative<Choice>(key.access) ||
         std::holds_alternative<Member<std::string>>(key.access);
}

/// A key or a whole section before it is looked up.
struct Entry {
  std::string_view section; ///< "" for what stands at the top
  std::string_view name;
  std::size_t line;
  const toml::node* value;
};

std::vector<Entry> entries_by_line(const toml::table& table) {
  std::vector<Entry> entries;
  for (const auto& [key, value] : table) {
    const toml::table* section = is_section(key.str()) ? value.as_table() : nullptr;
    if (section)
      for (const auto& [inner, inner_value] : *section)
        entries.push_back({key.str(), inner.str(), inner.source().begin.line, &inner_value});
    else
      entries.push_back({"", key.str(), key.source().begin.line, &value});
  }
  std::ranges::stable_sort(entries, {}, &Entry::line);
  return entries;
}

} // namespace

void refuse_scene(std::string message) {
  constexpr std::size_t longest = 1000;
  if (message.size() > longest) message = message.substr(0, longest) + " ...";
  for (char& c : message)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  throw SceneError(message);
}

std::string shortened(std::string_view text) {
  constexpr std::size_t longest = 60;
  return text.size() <= longest ? std::string(text) : fmt::format("{}...", text.substr(0, longest));
}

std::string read_text(const std::filesystem::path& file) {
  try {
    return file_text(file, largest_text + 1);
  } catch (const StoreError& e) {
    refuse_scene(e.what());
  }
}

toml::table parse_toml(std::string_view text, const std::string& source) {
  refuse_rubbish(text, source);
  try {
    return toml::parse(text, std::string_view(source));
  } catch (const toml::parse_error& error) {
    refuse_scene(fmt::format("{}this is not TOML: {}", at_line(source, error.source().begin.line),
                             error.description()));
  }
}

std::string Given::path() const {
  return key->section.empty() ? name : fmt::format("{}.{}", key->section, name);
}

std::vector<Given> parse_document(std::string_view text, const std::string& source) {
  const auto table = std::make_shared<const toml::table>(parse_toml(text, source));
  std::vector<Given> given;
  for (const Entry& e : entries_by_line(*table)) {
    const std::string place = at_line(source, e.line);
    if (e.section.empty() && is_section(e.name))
      refuse_scene(fmt::format("{}{}: this is a section; allowed: [{}], then its keys", place,
                               e.name, e.name));
    if (e.section.empty() && e.value->is_table()) refuse_section(place, e.name);
    given.push_back({&known_key(place, e.section, e.name),
                     std::string(e.name),
                     {table, e.value},
                     place,
                     false});
  }
  if (given.empty())
    refuse_scene(source +
                 ":1: the scene is empty; allowed: at least one key, such as kind in [shape]");
  return given;
}

Given parse_override(const std::string& argument) {
  const std::string place = fmt::format("--set {}: ", shortened(argument));
  const auto trimmed = [](std::string_view text) {
    const auto first = text.find_first_not_of(" \t");
    return first == text.npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
  };
  const std::size_t equals = argument.find('=');
  const std::string_view path = trimmed(std::string_view(argument).substr(0, equals));
  const std::string_view text =
      equals == argument.npos ? "" : trimmed(std::string_view(argument).substr(equals + 1));
  if (path.empty() || text.empty())
    refuse_scene(place + "no key and value; allowed: section.key=value, such as grid.nodes=96");

  const std::size_t dot = path.find('.');
  const auto section = dot == path.npos ? std::string_view() : path.substr(0, dot);
  const std::string name(dot == path.npos ? path : path.substr(dot + 1));
  const Key& key = known_key(place, section, name);

  refuse_rubbish(text, "--set " + shortened(argument));
  toml::table table;
  std::string trouble = "more than one value";
  try {
    table = toml::parse(fmt::format("value = {}", text), std::string_view("--set"));
  } catch (const toml::parse_error& error) {
    trouble = error.description();
  }
  if (table.size() != 1 && !takes_text(key))
    refuse_scene(fmt::format("{}{}: not a TOML value ({}); allowed: {}", place, key.label(),
                             trouble, allowed_text(key)));
  if (table.size() != 1) table = toml::table{{"value", text}};
  const auto shared = std::make_shared<const toml::table>(std::move(table));
  return {&key, name, {shared, shared->get("value")}, place, true};
}

} // namespace lamella
