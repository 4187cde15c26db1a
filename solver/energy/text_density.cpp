#include "energy/text_density.h"

#include <algorithm>

namespace lamella {

TextDensity::TextDensity(const std::string& ld, const std::string& lo, const FormulaNames& names) {
  const std::string &KM = names.variables[0], &K = names.variables[1];
  for (const std::string& text : ld == lo ? std::vector{ld} : std::vector{ld, lo}) {
    const std::string formula = text.empty() ? "0" : text;
    phases_.push_back({read_formula(formula, names), read_formula(formula, names, {{}, {KM}, {K}}),
                       read_formula(formula, names, {{KM, KM}, {KM, K}, {K, K}})});
  }
}

Derivatives TextDensity::needs() const {
  const auto f_K_varies = [](const Phase& p) { return !p.partials.dependences[2].empty(); };
  const auto f_MM_varies = [](const Phase& p) { return !p.second.dependences[0].empty(); };
  if (std::ranges::any_of(phases_, f_K_varies)) return Derivatives::all;
  return std::ranges::any_of(phases_, f_MM_varies) ? Derivatives::gradient : Derivatives::laplacian;
}

template <int count, class N>
std::array<N, count> TextDensity::at(const SurfacePoint<N>& point, Formula Phase::*formula) const {
  static thread_local std::vector<N> registers;
  const std::array<N, 2> variables{point.KM, point.K};
  std::array<N, count> results;
  (phases_[0].*formula).tape.evaluate<N>(variables, results, registers);
  if (phases_.size() == 1) return results;
  std::array<N, count> lo;
  (phases_[1].*formula).tape.evaluate<N>(variables, lo, registers);
  for (int i = 0; i < count; i++)
    results[i] = results[i] + point.steps.monotonic * (lo[i] - results[i]);
  return results;
}

template <class N>
Lanes TextDensity::add_partials(const SurfacePoint<N>& point, Partials<N>& sum) const {
  const auto [f, by_KM, by_K] = at<3>(point, &Phase::partials);
  sum.by_KM = sum.by_KM + by_KM;
  sum.by_K = sum.by_K + by_K;
  return value_of(f);
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
  const auto [KM_KM, KM_K, K_K] = at<3>(point, &Phase::second);
  sum.KM_KM += KM_KM;
  sum.KM_K += KM_K;
  sum.K_K += K_K;
}

Univariate TextDensity::across(const SurfacePoint<Univariate>& point) const {
  return at<1>(point, &Phase::value)[0];
}

} // namespace lamella
