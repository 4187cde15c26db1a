#pragma once
#include "energy/surface_term.h"
#include "expression/formula.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace lamella {

/// int f(K_M, K, material fields) dA with a density f that is given as a text, see read_formula;
/// energy/length^2.
/// Between the phases f goes from that of Ld to that of Lo with the monotonic step.
class TextDensity : public SurfaceTerm {
public:
  /// A text may be empty, which is 0. Throws FormulaError.
  TextDensity(const std::string& ld, const std::string& lo, const Parameters& parameters,
              const MaterialFields& fields = {});

  TermName term() const override { return Term::density; }
  Derivatives needs() const override;
  bool differs_between_phases() const override { return phases_.size() > 1; }

  Lanes add(const SurfacePoint<AffineJet>& at, Partials<AffineJet>& sum) const override;
  Lanes add(const SurfacePoint<Jet>& at, Partials<Jet>& sum) const override;
  Lanes add(const SurfacePoint<Lanes>& at, Partials<Lanes>& sum) const override;
  void add(const SurfacePoint<Lanes>& at, SecondPartials& sum) const override;
  Univariate across(const SurfacePoint<Univariate>& at) const override;

private:
  struct Phase {
    Formula value, partials, second; ///< f; f, f_M, f_K; f_MM, f_MK, f_KK
    Formula by_amounts;              ///< df/dm, m the fields whose amounts are carried
  };

  /// Each of a formula's results, between the phases where these differ.
  template <class N>
  std::span<const N> at(const SurfacePoint<N>& point, Formula Phase::*formula) const;
  template <class N>
  Lanes add_partials(const SurfacePoint<N>& point, Partials<N>& sum) const;

  std::vector<Phase> phases_;        ///< one, or Ld and Lo
  std::vector<std::size_t> amounts_; ///< which of the fields are carried as amounts
};

} // namespace lamella
