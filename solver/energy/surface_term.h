#pragma once
#include "energy/coefficient.h"
#include "energy/energy_terms.h"
#include "energy/functions_of_duals.h"
#include "energy/surface_jet.h"
#include "geometry/surface_geometry.h"

#include <memory>
#include <span>
#include <vector>

namespace lamella {

using Jet = SurfaceJet<Lanes>;

/// What a density is a function of, at eight places of the membrane or, with Univariate, at one.
template <class N>
struct SurfacePoint {
  N KM, K;
  Steps<N> steps;
  std::span<const N> fields = {}; ///< material fields, in the order of the scene
};

/// Partial derivatives of a density, or of the sum of several.
template <class N>
struct Partials {
  N by_KM = constant<N>(0), by_K = constant<N>(0);
  /// Sum of m df/dm over the material fields m whose amounts are carried: where the membrane
  /// grows they fall.
  Lanes by_amounts = Lanes{};
};

/// Second partial derivatives of a density: how stiff it is.
struct SecondPartials {
  Lanes KM_KM = Lanes{}, KM_K = Lanes{}, K_K = Lanes{};
};

/// A term of the Hamiltonian that is an integral over the membrane, int f(K_M, K) dA, with
/// coefficients that may differ between phases (Eq. 5). Every add() returns the density f at the
/// places and adds its partial derivatives: as jets for the variation where all is smooth, as plain
/// numbers for the weak form. On top of f comes of_gradient() times |grad_s K_M|^2.
class SurfaceTerm {
public:
  virtual ~SurfaceTerm() = default;

  virtual TermName term() const = 0;
  /// Where coefficients do not vary.
  virtual Derivatives needs() const = 0;
  virtual bool differs_between_phases() const = 0;
  /// Energy length^2. Terms that have it need Derivatives::sixth.
  virtual Coefficient of_gradient() const { return {}; }

  /// Only for terms that need no more than the Laplacian, where coefficients do not vary.
  virtual Lanes add(const SurfacePoint<AffineJet>& at, Partials<AffineJet>& sum) const = 0;
  virtual Lanes add(const SurfacePoint<Jet>& at, Partials<Jet>& sum) const = 0;
  virtual Lanes add(const SurfacePoint<Lanes>& at, Partials<Lanes>& sum) const = 0;
  /// Adds the second partial derivatives.
  virtual void add(const SurfacePoint<Lanes>& at, SecondPartials& sum) const = 0;
  /// The density along a way across the phase boundary, as a function of the distance from it.
  virtual Univariate across(const SurfacePoint<Univariate>& at) const = 0;
};

/// Terms of a run besides those of its scene.
using SurfaceTerms = std::vector<std::shared_ptr<const SurfaceTerm>>;

/// What a term needs to write is its density, as
///   template <class C, class N> N density(const Steps<C>& steps, const N& KM, const N& K) const,
/// where coefficients are of type C and the curvatures of type N, which may carry derivatives; and
/// whether it depends on K. Densities are made of +, -, *, constant<N>(2.5), apply(Function::sqrt,
/// K), and coefficients that may differ between phases, Coefficient::at(steps).
template <class Density>
class DensityTerm : public SurfaceTerm {
public:
  Lanes add(const SurfacePoint<AffineJet>& at, Partials<AffineJet>& sum) const override {
    return add_partials(at, sum);
  }
  Lanes add(const SurfacePoint<Jet>& at, Partials<Jet>& sum) const override {
    return add_partials(at, sum);
  }
  Lanes add(const SurfacePoint<Lanes>& at, Partials<Lanes>& sum) const override {
    return add_partials(at, sum);
  }
  void add(const SurfacePoint<Lanes>& at, SecondPartials& sum) const override {
    using D = Dual<Lanes>;
    const Lanes one = lanes_of(1), none = Lanes{};
    const D by{one, none}, not_by{none, none};
    auto second = [&](bool first_by_K, bool then_by_K) {
      const Dual<D> x{{at.KM, then_by_K ? none : one}, first_by_K ? not_by : by},
          y{{at.K, then_by_K ? one : none}, first_by_K ? by : not_by};
      return Lanes(self().density(at.steps, x, y).d.d);
    };
    sum.KM_KM += second(false, false);
    if constexpr (!Density::depends_on_K) return;
    sum.KM_K += second(false, true);
    sum.K_K += second(true, true);
  }
  Univariate across(const SurfacePoint<Univariate>& at) const override {
    return self().density(at.steps, at.KM, at.K);
  }

private:
  const Density& self() const { return static_cast<const Density&>(*this); }

  template <class N>
  Lanes add_partials(const SurfacePoint<N>& at, Partials<N>& sum) const {
    const N one = constant<N>(1), none = constant<N>(0);
    const Dual<N> by_KM = self().density(at.steps, Dual<N>{at.KM, one}, Dual<N>{at.K, none});
    sum.by_KM = sum.by_KM + by_KM.d;
    if constexpr (Density::depends_on_K) {
      const Dual<N> by_K = self().density(at.steps, Dual<N>{at.KM, none}, Dual<N>{at.K, one});
      sum.by_K = sum.by_K + by_K.d;
    }
    return value_of(by_KM.f);
  }
};

} // namespace lamella
