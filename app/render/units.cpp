#include "render/units.h"

#include "render/labels.h"
#include "scene/units.h"
#include "store/history.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace lamella::render {
namespace {

using Notations = std::map<std::string, Notation, std::less<>>;

/// Of columns of history.csv; others are called as they are there.
const std::map<std::string_view, std::pair<const char*, const char*>> names{
    {"t", {"time", "*t*"}},
    {"dt", {"time step", ""}},
    {"energy", {"energy", "*E*"}},
    {"bending_energy", {"bending energy", ""}},
    {"gaussian_energy", {"Gaussian energy", ""}},
    {"stretch_energy", {"stretch energy", ""}},
    {"int_KM2", {"", "∫ *K*_{M}² d*A*"}},
    {"P", {"pressure", "*P*"}},
    {"sigma", {"tension", "*σ*"}},
    {"K_multiplier", {"multiplier", "*q*"}},
    {"A", {"area", "*A*"}},
    {"V", {"volume", "*V*"}},
    {"v", {"reduced volume", "*v*"}},
    {"Da", {"area difference", "Δ*a*"}},
    {"dA_rel", {"error of the area", ""}},
    {"work", {"work of constraints in a step", ""}},
    {"dissipated", {"energy dissipated in a step", ""}},
    {"energy_rise", {"rise of the energy in a step", ""}},
    {"dV_rel", {"error of the volume", ""}},
    {"max_speed", {"largest speed", ""}},
    {"bending_Ld", {"bending of Ld", ""}},
    {"bending_Lo", {"bending of Lo", ""}},
    {"line_energy", {"line energy", ""}},
    {"sigma_Ld", {"tension", "*σ*_{Ld}"}},
    {"sigma_Lo", {"tension", "*σ*_{Lo}"}},
    {"A_Ld", {"area", "*A*_{Ld}"}},
    {"A_Lo", {"area", "*A*_{Lo}"}},
    {"dA_Ld_rel", {"error of the area of Ld", ""}},
    {"line_length", {"length of the boundary", ""}},
    {"line_radius", {"radius of the boundary", ""}},
    {"max_line_speed", {"largest speed of the boundary", ""}},
    {"domains_Ld", {"Ld domains", ""}},
    {"domains_Lo", {"Lo domains", ""}},
    {"c_min", {"least", "*c*"}},
    {"c_max", {"greatest", "*c*"}},
};

Notations all_notations() {
  Notations all{{"K_M", {"", "*K*_{M}", "1/length"}}, // fields on the membrane
                {"K", {"", "*K*", "1/length²"}},
                {"energy_density", {"energy density", "", "energy/length²"}},
                {"c", {"lipid per area,", "*c*"}},
                {"velocity", {"", "*v*_{N}", "length/time"}}};
  Measures measures;
  measures.phases.emplace();
  measures.stretch.emplace();
  measures.balance.emplace();
  measures.energy_rise = 0;
  for (const TermInfo& term : energy_term_table) {
    measures.terms[term.term] = 0;
    const bool has_symbol = *term.symbol != '\0';
    all[term.column] = {has_symbol ? "energy of" : fmt::format("energy of {}", term.label),
                        term.symbol, ""};
  }
  for (const Field& field : row_of(measures)) {
    const auto known = names.find(field.column);
    Notation& notation = all[field.column];
    notation.unit_in_scene = field.unit;
    if (known != names.end())
      std::tie(notation.name, notation.letter) = known->second;
    else if (notation.name.empty())
      notation.name = field.column;
  }
  return all;
}

/// Factors beside each other; letters that meet become one slanted word.
std::string product(std::string a, std::string b) {
  if (a.ends_with('*') && b.starts_with('*')) {
    a.pop_back();
    b.erase(0, 1);
  }
  return a + b;
}

std::string power(const std::string& symbol, int exponent) {
  if (exponent == 0) return {};
  return exponent == 1 ? symbol : symbol + superscript(exponent);
}

} // namespace

Units::Units(const Scene& scene) : kappa(scene.membrane.bending_modulus) {
  if (!scene.has_phases()) return;
  const double Ld = scene.ld.bending_modulus, Lo = scene.lo.bending_modulus;
  kappa = std::min(Ld, Lo);
  if (Ld != Lo) kappa_symbol += Ld < Lo ? "_{Ld}" : "_{Lo}";
}

Units common(const Units& a, const Units& b) {
  Units both = a;
  if (a.kappa_symbol != b.kappa_symbol) both.kappa_symbol = Units().kappa_symbol;
  return both;
}

double Notation::value(double in_scene, const Units& units) const {
  return in_scene * UnitChange{.energy = 1 / units.kappa}.factor(unit_in_scene);
}

std::string Notation::unit(const Units& units) const {
  const auto [length, energy, time] = dimension_of(unit_in_scene); // of time: zeta L^4 / kappa
  const auto text = [&, zeta = time, kappa = energy - time, l = length + 4 * time](auto&& part) {
    return product(product(power("*ζ*", part(zeta)), power(units.kappa_symbol, part(kappa))),
                   power("*L*", part(l)));
  };
  const std::string above = text([](int n) { return std::max(n, 0); }),
                    below = text([](int n) { return std::max(-n, 0); });
  if (above.empty()) return text([](int n) { return n; });
  return below.empty() ? above : above + "/" + below;
}

std::string Notation::symbol() const {
  return name.empty() || letter.empty() ? name + letter : name + " " + letter;
}

std::string Notation::title(const Units& units) const { return with_unit(symbol(), unit(units)); }

std::string with_unit(const std::string& name, const std::string& unit) {
  if (unit.empty()) return name;
  const bool is_composed = unit.find_first_of("/ ") != unit.npos;
  return name + " / " + (is_composed ? "(" + unit + ")" : unit);
}

const Notation* find_notation(std::string_view name) {
  static const Notations notations = all_notations();
  const auto found = notations.find(name);
  return found == notations.end() ? nullptr : &found->second;
}

const Notation& notation_of(std::string_view name) {
  if (const Notation* notation = find_notation(name)) return *notation;
  throw std::logic_error(std::string(name) + " has no notation");
}

Notation notation_on_membrane(std::string_view name) {
  if (const Notation* notation = find_notation(name)) return *notation;
  return {"", fmt::format("*{}*", name)};
}

std::string time_label(double time, const Units& units) {
  const Notation& t = notation_of("t");
  const std::string value = t.letter + " = " + number(t.value(time, units));
  return time == 0 ? value : value + " " + t.unit(units);
}

} // namespace lamella::render
