#pragma once
#include "energy/surface_term.h"
#include "geometry/surface_geometry.h"
#include "scene/scene.h"

#include <memory>
#include <span>
#include <vector>

namespace lamella {

/// The part of the Hamiltonian that is integrals over the membrane of functions of its curvatures
/// (Eq. 5): the list of terms that a scene needs, and the one place where their forces and energies
/// are put together, with one phase and with two.
class SurfaceEnergy {
public:
  /// The membrane where the phases meet: samples within a few spacings of the boundary.
  struct Strip {
    std::vector<int> sample;
    std::vector<SurfaceJet<double>> psi; ///< distance from the boundary, < 0 in Ld
    /// What is known of psi besides where the phases have different gradient moduli.
    struct Further {
      std::array<double, 6> hess;     ///< grad_s grad_s psi: xx, yy, zz, xy, xz, yz
      std::array<double, 3> grad_lap; ///< grad_s Lap_s psi
    };
    std::vector<Further> further; ///< empty where they are the same
  };

  /// At the samples, of each material field in turn.
  using FieldJets = std::span<const std::span<const SurfaceJet<double>>>;

  /// Nothing but the terms of a membrane of one phase. `parameters`, `fields`: of densities as
  /// text.
  explicit SurfaceEnergy(const SurfaceModuli& membrane, const Parameters& parameters = {},
                         const MaterialFields& fields = {});
  /// Of two, with the profiles that moduli follow across the boundary. `geodesic_modulus`: of the
  /// boundary, which by Gauss and Bonnet is, but for a constant, a Gaussian modulus of Ld.
  SurfaceEnergy(const SurfaceModuli& ld, const SurfaceModuli& lo, double geodesic_modulus,
                const StepProfiles& profiles, const Parameters& parameters = {},
                const MaterialFields& fields = {});

  /// One more. Throws std::invalid_argument for one whose name is none, see is_term_name().
  void add(std::shared_ptr<const SurfaceTerm> term);

  const SurfaceTerms& terms() const { return terms_; }

  /// What the samples must be known by.
  Derivatives needs() const;
  /// Whether the phases have different moduli.
  bool differs() const;
  /// Whether they have different moduli of the gradient of K_M.
  bool gradient_differs() const;

  /// The variation F at the samples: a displacement u along N, which takes material fields along,
  /// changes the energy by int F u dA. `is_Ld`: of samples off the strip; empty: one phase.
  /// Energies are then those of these samples.
  void find_forces(const SurfaceGeometry& surface, std::span<const char> is_Ld, const Strip& strip,
                   std::span<double> variation, FieldJets fields = {});

  /// How strongly short waves are resisted: the energy of a normal displacement by a wave of wave
  /// number k is k^4 / 2 times its square times a number between the first two, and k^6 / 2 times
  /// its square times one between those of the gradient of K_M.
  struct Stiffness {
    double least = 0, most = 0;
    std::size_t softest = 0; ///< the sample where it is least
    double least_gradient = 0, most_gradient = 0;
  };
  /// Over the samples, `is_Ld` as above.
  Stiffness stiffness(const SurfaceGeometry& surface, std::span<const char> is_Ld,
                      FieldJets fields) const;

  /// Energy density along a way across the phase boundary, where the distance from it is psi.
  /// `slope2`: |grad_s K_M|^2; only where gradient_differs(). `fields`: their values there.
  Univariate across(double psi, double KM, double K, double slope2,
                    std::span<const double> fields) const;

  /// Energy density of a membrane of one phase at a point. `slope2`: |grad_s K_M|^2; only where
  /// Derivatives::sixth are needed. `fields`: their values there.
  double density(double KM, double K, double slope2 = 0, std::span<const double> fields = {}) const;

  /// Adds the energies of the terms to those that are there.
  void find_energies(const SurfaceGeometry& surface, EnergyTerms& terms) const;
  /// Of the Ld phase, whose share of the samples is given.
  double bending_Ld(const SurfaceGeometry& surface, std::span<const double> share) const;

private:
  template <class Monomial>
  void add_if(const Coefficient& modulus);
  /// No partial derivative is more than affine in K_M where coefficients do not vary.
  bool is_affine() const;
  struct GradientSquare;
  template <class N, class Where>
  void find_at(const SurfacePoint<N>& p, const GradientSquare* gradient, const Where& at,
               std::span<double> variation);
  template <class N>
  void find_bulk(const SurfaceGeometry& surface, std::span<const char> is_Ld, FieldJets fields,
                 std::span<double> variation);
  void find_strip(const SurfaceGeometry& surface, const Strip& strip, FieldJets fields,
                  std::span<double> variation);

  SurfaceTerms terms_;
  std::vector<std::vector<double>> density_; ///< of each term at the samples
  StepProfiles profiles_;
};

} // namespace lamella
