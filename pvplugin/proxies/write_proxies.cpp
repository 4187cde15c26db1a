// write_proxies IN OUT: server manager XML with the parameters of scenes written out, from the
// table that scenes are read with. In IN, <Parameters of="X"/> stands for their properties and
// groups, X being vesicle (all of them), source or dynamics (those of vtkVesicleSource,
// vtkVesicleDynamics).
#include "labels.h"
#include "names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <iterator>
#include <stdexcept>

namespace lamella {
namespace {

enum class Owner { vesicle, source, dynamics };

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::ranges::find(words, word) != words.end();
}

bool has(Owner owner, const Key& key) {
  if (key.section.empty()) return key.name == "fields" && owner != Owner::source;
  if (key.name == "start_times") return false; // with targets
  if (owner == Owner::vesicle) return true;
  const bool of_source = is_one_of(key.section, {"grid", "shape", "perturbation", "domains"}) &&
                         key.name != "curvature_start_time";
  return key.name != "file" && of_source == (owner == Owner::source);
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

/// Shows a property only where it counts.
std::string decorator(Owner owner, const Key& key) {
  if (key.cases.empty()) return "";
  const Key& choice = choice_key(key.section);
  if (!has(owner, choice)) // the phases are those of the input
    return fmt::format(R"(<PropertyWidgetDecorator type="lamella_phases" phases="{}"/>)",
                       key.cases.front() == "none" ? 1 : 2);
  return fmt::format(
      R"(<PropertyWidgetDecorator type="GenericDecorator" mode="visibility" property="{}" {}="{}"/>)",
      property_name(choice), key.cases.size() == 1 ? "value" : "values", fmt::join(key.cases, " "));
}

std::string documentation(const Key& key) {
  std::string text(key.help);
  text[0] = char(std::toupper(text[0]));
  if (!key.unit.empty()) text += fmt::format("; unit: {}", key.unit);
  if (key.name.empty()) text += "; all of them in one line, as in a = 3, b = -2";
  if (key.name == "fields")
    text += R"(; as in {name = "m", start = "1 + 0.2*z", carried = "value"})";
  return fmt::format("{}. Allowed: {}. In scene files: {}.", text, allowed_text(key), key.label());
}

/// Of numbers; both ends, which make a slider, only where it is of use.
std::string range_domain(std::string_view type, const Range& range) {
  constexpr double for_sliders = 512, unlimited = 1e6;
  std::string ends;
  if (range.low > -unlimited) ends += fmt::format(" min=\"{:g}\"", range.low);
  if (range.high <= for_sliders) ends += fmt::format(" max=\"{:g}\"", range.high);
  return ends.empty() ? "" : fmt::format("<{}RangeDomain name=\"range\"{}/>", type, ends);
}

/// A property without its name and label: the kind of element, attributes, domain, hints.
struct Form {
  std::string element, attributes, domain = {}, hints = {};
};

/// What sets a parameter: its own method, or one of vtkVesicle for all of a type.
std::string setter(Owner owner, const Key& key, std::string_view type) {
  return owner == Owner::vesicle
             ? fmt::format(R"(command="Set{}" initial_string="{}")", type, key.path())
             : fmt::format(R"(command="Set{}")", property_name(key));
}

Form list_form(std::string_view entry, std::initializer_list<std::string_view> columns) {
  Form form{"DoubleVectorProperty",
            fmt::format(R"(command="Add{0}" clean_command="RemoveAll{0}s" repeat_command="1" )"
                        R"(number_of_elements_per_command="{1}")",
                        entry, columns.size())};
  form.hints = "<ShowComponentLabels>";
  for (int n = 0; const std::string_view column : columns)
    form.hints += fmt::format(R"(<ComponentLabel component="{}" label="{}"/>)", n++, column);
  form.hints += "</ShowComponentLabels>";
  return form;
}

template <class Values>
Form numbers_form(std::string_view type, const std::string& command, const Values& values,
                  const Range& range) {
  return {fmt::format("{}VectorProperty", type),
          fmt::format(R"({} number_of_elements="{}" default_values="{}")", command, values.size(),
                      fmt::join(values, " ")),
          range_domain(type, range)};
}

/// The form of each type of parameter.
struct FormOf {
  Owner owner;
  const Key& key;
  Scene scene{}; // of defaults

  Form operator()(Member<double> x) {
    return numbers_form("Double", setter(owner, key, "Number"), std::array{x(scene)}, key.range);
  }
  Form operator()(Member<int> n) {
    return numbers_form("Int", setter(owner, key, "Number"), std::array{n(scene)}, key.range);
  }
  Form operator()(Member<bool> flag) {
    Form form =
        numbers_form("Int", setter(owner, key, "Number"), std::array{int(flag(scene))}, key.range);
    form.domain = R"(<BooleanDomain name="bool"/>)";
    return form;
  }
  Form operator()(Member<Vec3> x) {
    return numbers_form("Double", setter(owner, key, "Vector"), x(scene), key.range);
  }
  Form operator()(Member<std::array<int, 3>> n) {
    return numbers_form("Int", setter(owner, key, "Vector"), n(scene), key.range);
  }
  Form operator()(Member<std::string>) {
    return {"StringVectorProperty",
            setter(owner, key, "Text") + R"( number_of_elements="1" default_values="")",
            key.name == "file" ? R"(<FileListDomain name="files"/>)" : ""};
  }
  Form operator()(Member<Parameters>) {
    return {"StringVectorProperty",
            setter(owner, key, "Text") + R"( number_of_elements="1" default_values="")"};
  }
  Form operator()(Member<MaterialFields>) {
    return {"StringVectorProperty",
            setter(owner, key, "Text") + R"( number_of_elements="1" default_values="")"};
  }
  Form operator()(const Choice& choice) {
    Form form{"StringVectorProperty",
              fmt::format(R"({} number_of_elements="1" default_values="{}")",
                          setter(owner, key, "Text"), choice.names.at(choice.get(scene)))};
    form.domain = R"(<StringListDomain name="list">)";
    for (const std::string_view name : choice.names)
      if (owner == Owner::vesicle || name != "frame")
        form.domain += fmt::format(R"(<String value="{}"/>)", name);
    form.domain += "</StringListDomain>";
    return form;
  }
  Form operator()(Member<std::vector<double>>) {
    return list_form(camel(key.section) + "Target", {"target", "start time"});
  }
  Form operator()(Member<std::vector<Vec3>>) { return list_form("Domain", {"x", "y", "z"}); }
};

std::string property(Owner owner, const Key& key, const Label& label) {
  const Form form = std::visit(FormOf{owner, key}, key.access);
  return fmt::format("      <{0} name=\"{1}\" label=\"{2}\" {3} panel_visibility=\"{4}\">{5}\n"
                     "        <Documentation>{6}</Documentation>\n"
                     "        <Hints>{7}{8}</Hints>\n"
                     "      </{0}>\n",
                     form.element, property_name(key), label.text, form.attributes,
                     label.advanced ? "advanced" : "default", form.domain,
                     escaped(documentation(key)), form.hints, decorator(owner, key));
}

std::vector<Group> groups_with_all() {
  std::vector<Group> groups = panel_groups();
  for (const Key& key : scene_keys()) {
    if (!has(Owner::vesicle, key)) continue;
    const bool named = std::ranges::any_of(groups, [&](const Group& group) {
      return std::ranges::any_of(group.labels,
                                 [&](const Label& label) { return label.key == key.path(); });
    });
    if (!named) throw std::runtime_error(key.label() + " has no label in labels.h");
  }
  return groups;
}

std::string parameters(Owner owner) {
  std::string properties, groups;
  for (const Group& group : groups_with_all()) {
    std::string members;
    for (const Label& label : group.labels) {
      const auto dot = label.key.find('.');
      const Key* key = dot != label.key.npos
                           ? find_key(label.key.substr(0, dot), label.key.substr(dot + 1))
                       : keys_of_section(label.key).empty() ? find_key("", label.key)
                                                            : find_key(label.key, "");
      if (!key) throw std::runtime_error(fmt::format("labels.h: there is no {}", label.key));
      if (!has(owner, *key)) continue;
      properties += property(owner, *key, label);
      members += fmt::format("        <Property name=\"{}\"/>\n", property_name(*key));
    }
    if (!members.empty())
      groups += fmt::format("      <PropertyGroup label=\"{}\">\n{}      </PropertyGroup>\n",
                            group.title, members);
  }
  return properties + groups;
}

void replace(std::string& text, std::string_view place, const std::string& by) {
  if (const auto at = text.find(place); at != text.npos) text.replace(at, place.size(), by);
}

void write_proxies(const char* in, const char* out) {
  std::ifstream source(in);
  std::string text{std::istreambuf_iterator<char>(source), {}};
  replace(text,
          R"(      <Parameters of="vesicle"/>)"
          "\n",
          parameters(Owner::vesicle));
  replace(text,
          R"(      <Parameters of="source"/>)"
          "\n",
          parameters(Owner::source));
  replace(text,
          R"(      <Parameters of="dynamics"/>)"
          "\n",
          parameters(Owner::dynamics));
  std::ofstream(out) << text;
}

} // namespace
} // namespace lamella

int main(int count, char** arguments) {
  try {
    if (count != 3) throw std::runtime_error("write_proxies IN OUT");
    lamella::write_proxies(arguments[1], arguments[2]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
