#include "scene/units.h"

#include "expression/formula_text.h"
#include "scene/densities.h"
#include "scene/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lamella {

namespace {

/// What formulas are of, and its unit.
constexpr std::pair<std::string_view, std::string_view> variables[]{
    {"KM", "1/length"},    {"K", "1/length²"}, {"kg", "1/length"}, {"kn", "1/length"},
    {"tau_g", "1/length"}, {"x", "length"},    {"y", "length"},    {"z", "length"}};

Dimension of_word(std::string_view word) {
  return {word == "length", word == "energy", word == "time"};
}

/// Of a product such as "energy time" or "length³".
Dimension of_product(std::string_view product) {
  constexpr std::pair<std::string_view, int> powers[]{{"²", 2}, {"³", 3}, {"⁴", 4}};
  Dimension sum;
  while (!product.empty()) {
    std::string_view word = product.substr(0, product.find(' '));
    product.remove_prefix(std::min(product.size(), word.size() + 1));
    int power = 1;
    for (const auto& [sign, n] : powers)
      if (word.ends_with(sign)) {
        power = n;
        word.remove_suffix(sign.size());
      }
    const Dimension d = of_word(word);
    sum.length += power * d.length;
    sum.energy += power * d.energy;
    sum.time += power * d.time;
  }
  return sum;
}

/// A formula with the same values, of curvatures and places in other units.
std::string formula_in_units(std::string_view text, const UnitChange& change) {
  std::string changed;
  for (const Token& token : FormulaText(text).tokens()) {
    const auto variable = std::ranges::find_if(
        variables, [&](const auto& known) { return known.first == token.text; });
    changed += variable == std::end(variables)
                   ? std::string(token.text)
                   : fmt::format("({}*{})", 1 / change.factor(variable->second), token.text);
  }
  return changed;
}

} // namespace

Dimension dimension_of(std::string_view unit) {
  const std::size_t slash = unit.find('/');
  const Dimension above = of_product(unit.substr(0, slash));
  const Dimension below = slash == unit.npos ? Dimension{} : of_product(unit.substr(slash + 1));
  return {above.length - below.length, above.energy - below.energy, above.time - below.time};
}

double UnitChange::factor(std::string_view unit) const {
  const Dimension d = dimension_of(unit);
  return std::pow(length, d.length + 4 * d.time) * std::pow(energy, d.energy - d.time);
}

Scene in_units(Scene scene, const UnitChange& change) {
  for (const Key& key : scene_keys()) {
    const double factor = change.factor(key.unit);
    if (factor == 1) continue;
    if (const auto* number = std::get_if<Member<double>>(&key.access)) (*number)(scene) *= factor;
    if (const auto* vector = std::get_if<Member<Vec3>>(&key.access))
      for (double& x : (*vector)(scene)) x *= factor;
    if (const auto* text = std::get_if<Member<std::string>>(&key.access))
      if (std::string& formula = (*text)(scene); !formula.empty())
        formula = fmt::format("{}*({})", factor, formula_in_units(formula, change));
    if (const auto* list = std::get_if<Member<std::vector<double>>>(&key.access))
      for (double& x : (*list)(scene)) x *= factor;
  }
  for (MaterialField& field : scene.fields)
    if (!array_of(field, scene.parameters)) field.start = formula_in_units(field.start, change);
  return scene;
}

} // namespace lamella
