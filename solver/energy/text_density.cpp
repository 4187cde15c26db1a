#include "energy/text_density.h"

#include "scene/densities.h"

#include <algorithm>

namespace lamella {

TextDensity::TextDensity(const std::string& ld, const std::string& lo, const Parameters& parameters,
                         const MaterialFields& fields) {
  const FormulaNames names = names_on_membrane(parameters, fields);
  const std::string &KM = names.variables[0], &K = names.variables[1];
  std::vector<DifferentiatedBy> by_amounts;
  for (std::size_t i = 0; i < fields.size(); i++)
    if (fields[i].carried == Carried::amount) {
      amounts_.push_back(i);
      by_amounts.push_back({fields[i].name});
    }
  for (const std::string& text : ld == lo ? std::vector{ld} : std::vector{ld, lo}) {
    const std::string formula = text.empty() ? "0" : text;
    phases_.push_back({read_formula(formula, names), read_formula(formula, names, {{}, {KM}, {K}}),
                       read_formula(formula, names, {{KM, KM}, {KM, K}, {K, K}}),
                       by_amounts.empty() ? Formula{} : read_formula(formula, names, by_amounts)});
  }
}

/// Where f_K depends on a curvature, all is needed of both; where anything but f itself varies
/// otherwise than f_M with K_M alone, what jets take with products. (Jets of fields bring their
/// own.)
Derivatives TextDensity::needs() const {
  Derivatives most = Derivatives::laplacian;
  for (const Phase& p : phases_) {
    const std::set<std::string>&f = p.value.dependences[0], &f_K = p.partials.dependences[2];
    if (f_K.contains("KM") || f_K.contains("K")) return Derivatives::all;
    const bool has_fields = std::ranges::any_of(f, [](auto& x) { return x != "KM" && x != "K"; });
    if (has_fields || !p.second.dependences[0].empty()) most = Derivatives::gradient;
  }
  return most;
}

/// Each of a formula's results, between the phases where these differ.
template <class N>
std::span<const N> TextDensity::at(const SurfacePoint<N>& point, Formula Phase::*formula) const {
  static thread_local std::vector<N> registers, variables, results, lo;
  variables.assign({point.KM, point.K});
  variables.insert(variables.end(), point.fields.begin(), point.fields.end());
  const Tape& tape = (phases_[0].*formula).tape;
  variables.resize(std::size_t(tape.variables()), constant<N>(0)); // fields that do not count
  results.resize(std::size_t(tape.results()));
  tape.evaluate<N>(variables, results, registers);
  if (phases_.size() == 1) return results;
  lo.resize(results.size());
  (phases_[1].*formula).tape.evaluate<N>(variables, lo, registers);
  for (std::size_t i = 0; i < results.size(); i++)
    results[i] = results[i] + point.steps.monotonic * (lo[i] - results[i]);
  return results;
}

template <class N>
Lanes TextDensity::add_partials(const SurfacePoint<N>& point, Partials<N>& sum) const {
  const std::span<const N> f = at(point, &Phase::partials); // f, f_M, f_K
  const Lanes density = value_of(f[0]);
  sum.by_KM = sum.by_KM + f[1];
  sum.by_K = sum.by_K + f[2];
  if (amounts_.empty()) return density;
  std::array<Lanes, most_fields> values;
  for (std::size_t i = 0; i < point.fields.size(); i++) values[i] = value_of(point.fields[i]);
  const SurfacePoint<Lanes> here{value_of(point.KM),
                                 value_of(point.K),
                                 {value_of(point.steps.accurate), value_of(point.steps.moments),
                                  value_of(point.steps.monotonic)},
                                 std::span(values).first(point.fields.size())};
  const std::span<const Lanes> by = at(here, &Phase::by_amounts);
  for (std::size_t i = 0; i < amounts_.size(); i++) sum.by_amounts += values[amounts_[i]] * by[i];
  return density;
}

Lanes TextDensity::add(const SurfacePoint<AffineJet>& point, Partials<AffineJet>& sum) const {
  return add_partials(point, sum);
}
Lanes TextDensity::add(const SurfacePoint<Jet>& point, Partials<Jet>& sum) const {
  return add_partials(point, sum);
}
Lanes TextDensity::add(const SurfacePoint<Lanes>& point, Partials<Lanes>& sum) const {
  return add_partials(point, sum);
}

void TextDensity::add(const SurfacePoint<Lanes>& point, SecondPartials& sum) const {
  const std::span<const Lanes> f = at(point, &Phase::second);
  sum.KM_KM += f[0];
  sum.KM_K += f[1];
  sum.K_K += f[2];
}

Univariate TextDensity::across(const SurfacePoint<Univariate>& point) const {
  return at(point, &Phase::value)[0];
}

} // namespace lamella
