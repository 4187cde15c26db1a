#include "scene/units.h"

#include "expression/formula_text.h"
#include "scene/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lamella {

namespace {

constexpr std::string_view curvatures[]{"KM", "K", "kg", "kn", "tau_g"}; ///< that densities are of

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

/// A density with a factor, of curvatures in other units.
std::string density_in_units(std::string_view text, const UnitChange& change, double factor) {
  if (text.empty()) return "";
  std::string changed;
  for (const Token& token : FormulaText(text).tokens()) {
    const bool is_variable = std::ranges::count(curvatures, token.text) > 0;
    const double by = change.factor(token.text == "K" ? "length²" : "length");
    changed += is_variable ? fmt::format("({}*{})", by, token.text) : fmt::format("{}", token.text);
  }
  return fmt::format("{}*({})", factor, changed);
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
      (*text)(scene) = density_in_units((*text)(scene), change, factor);
    if (const auto* list = std::get_if<Member<std::vector<double>>>(&key.access))
      for (double& x : (*list)(scene)) x *= factor;
  }
  return scene;
}

} // namespace lamella
