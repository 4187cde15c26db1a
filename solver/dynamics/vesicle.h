#pragma once
#include "dynamics/components.h"
#include "dynamics/constraints.h"
#include "dynamics/measures.h"
#include "dynamics/phases.h"
#include "dynamics/start.h"
#include "dynamics/stretch_field.h"
#include "dynamics/surface_integrals.h"
#include "energy/film.h"
#include "energy/surface_energy.h"
#include "geometry/laplacian_field.h"
#include "geometry/surface_geometry.h"
#include "levelset/extension.h"
#include "levelset/level_set.h"

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lamella {

/// The membrane of a vesicle at one time: its level set, its samples, the forces on it, and the
/// constraints that it is on.
class Vesicle {
public:
  /// `more`: terms of the energy besides those of the scene.
  Vesicle(const Scene& scene, const Start& start, Fourier& fourier, const SurfaceTerms& more = {});

  /// All that the membrane is found from: what the last measurement began with. (What it found is
  /// many times as much, and comes out the same when it is made again.)
  struct State {
    Array<double> phi; ///< coefficients
    struct Field {
      Array<double> coefficients;
      double amount = 0; ///< CarriedField::amount
    };
    std::map<std::string, Field> fields; ///< by the names of evolving fields
    std::vector<HeldAreas::Part> held;   ///< where the scene has phases
    double fade = 0;                     ///< Phases::fade()
    NarrowBand::State band;
    Constraints::State constraints;
    std::vector<int> vesicle_of_node; ///< -1 outside; empty where there is one vesicle
  };
  State state() const;
  /// The membrane whose state() it was after it was measured at a time, to the last bit.
  Vesicle(const Scene& scene, const State& state, double time, Fourier& fourier,
          const SurfaceTerms& more = {});

  /// Finds everything that is known of the membrane after phi changed a little, having brought it
  /// onto its constraints at a time. Returns how far off them it was.
  Quantities measure(double time);
  /// The same after phi was changed by other means than a step. Returns the area before the
  /// correction.
  double measure_anew(double time);
  /// Which vesicles there are and what each holds: what is to be taken back where a change of phi
  /// is.
  struct Holdings {
    std::vector<int> vesicle_of_node;
    Constraints::State constraints;
  };
  Holdings holdings() const { return {components_.settled(), constraints_.state()}; }
  void restore(const Holdings& holdings);
  /// The box moved by so many cells.
  void shift(const std::array<int, 3>& cells);

  /// Vesicles that parted since the last step hold together what they held as one. From now on each
  /// keeps what it has of it.
  void keep_apart(double time);
  /// Lets an area difference that is free until now be held, where it is its time.
  bool set_out(double time);

  /// All terms.
  EnergyTerms energies() const;
  /// What changes of an energy of these terms are compared with: the sum of those that cannot be
  /// negative (bending, gradient, line tension, squares of the line, stretch, films), or the
  /// bending energy of a sphere, 8 pi kappa of the softer phase, where that is more. Never 0,
  /// unlike the energy.
  double energy_scale(const EnergyTerms& terms) const;
  /// All but the step.
  Measures measures(double time) const;
  /// Of each vesicle.
  std::vector<ComponentMeasures> component_measures(double time) const;
  /// What the multipliers of held quantities did since a time when these were the quantities and
  /// the multipliers. (A change of pressure or tension counts with its mean.)
  double work_since(const Quantities& before, const Multipliers& pulled) const;
  /// Largest relative deviation from the constraints.
  double drift(double time) const;
  /// Normal velocity at a sample (Eq. 80).
  double velocity(std::size_t sample) const;
  double max_speed() const { return max_speed_; }
  /// Of the phase boundary along the membrane.
  double max_line_speed() const;
  /// In which a bump of the size of the grid relaxes, of the membrane or of the phase boundary.
  double relaxation_time() const;
  double max_force() const { return max_force_; }
  /// What constraints, films and the start of spontaneous curvature allow.
  double longest_step(double time) const;
  /// Between two times the energy changes by other means than motion: a constraint is led on, or
  /// spontaneous curvature sets in.
  bool is_driven(double from, double to) const;
  /// A ramp begins or ends at this time, or spontaneous curvature sets in.
  bool turns_at(double time) const;

  const Grid& grid() const { return phi_.grid(); }
  LevelSet& phi() { return phi_; }
  const LevelSet& phi() const { return phi_; }
  const NarrowBand& band() const { return band_; }
  Extension& extension() { return extension_; }
  const SurfaceGeometry& surface() const { return surface_; }
  /// Of all vesicles together, and of each.
  const SurfaceIntegrals& integrals() const { return integrals_; }
  std::span<const SurfaceIntegrals> integrals_of_each() const { return of_each_; }
  /// Where they have something of their own: at the same time the same numbers for all that they
  /// hold together.
  const Components& components() const { return components_; }
  const Multipliers& multipliers() const { return multipliers_; }
  const Constraints& constraints() const { return constraints_; }
  /// What resists waves, at most: where only bending does, the bending modulus.
  double stiffness() const { return std::max(0.0, stiffness_.most); }
  /// The same of the gradient of K_M: a wave of wave number k is resisted with stiffness k^4 +
  /// gradient_stiffness k^6.
  double gradient_stiffness() const { return stiffness_.most_gradient; }
  /// A bending modulus that would resist a bump of the size of the grid, k = 1 / h, as much.
  double stiffness_of_grid() const;
  /// Nothing, or why the energy does not resist short waves everywhere.
  std::string why_not_stiff() const;
  /// The largest tension of a phase or a domain.
  double greatest_tension() const;
  /// Bound of kappa/2 C^2.
  double curvature_tension() const;
  /// Where the scene has domains.
  Phases* phases() { return phases_ ? &*phases_ : nullptr; }
  const Phases* phases() const { return phases_ ? &*phases_ : nullptr; }
  /// Where the scene has a stretch modulus.
  StretchField* stretch() { return stretch_ ? &*stretch_ : nullptr; }
  const StretchField* stretch() const { return stretch_ ? &*stretch_ : nullptr; }
  /// The scene's material fields.
  std::span<CarriedField> materials() { return materials_; }
  /// All that evolve on the membrane, those that the scene has.
  std::vector<EvolvingField*> fields();
  std::vector<const EvolvingField*> fields() const;
  /// Function m of 1, K_M, K, q K_M at a sample.
  double direction(int m, std::size_t sample) const;
  /// int g_i u dA over each vesicle for a displacement u of the samples, g = (1, K_M, K, q K_M).
  template <class Displacement>
  Eigen::Matrix4Xd moments(Displacement&& u) const;
  /// |grad phi| at the nearest points of band entries; 0 where it is not known.
  std::vector<double> grad_of_entries() const;

private:
  Vesicle(const Scene& scene, Fourier& fourier, const SurfaceTerms& more);

  /// One way to displace the membrane.
  struct Direction {
    std::vector<double> nodal; ///< change of phi at the band entries, tapered
    std::vector<double> moves; ///< the displacement at the samples
  };
  /// Of the four functions that multipliers push along; the last moves the phase boundary too, by
  /// -1 / drag.
  static constexpr int directions = 4, with_boundary = 3;

  void set_energy(SurfaceEnergy of_scene);
  void set_phases(const Scene& scene, std::span<const double> psi, Fourier& fourier);
  void start_materials(const Scene& scene, const Start& start, Fourier& fourier);
  void set_lengths(const Scene& scene);
  double leave_sphere();
  void settle_boundaries();
  void note_origin();
  void locate();
  void locate_membrane();
  void lead_to_constraints(double time);
  void set_directions();
  void evaluate_on_membrane(std::span<const double> change, std::vector<double>& moves);
  Eigen::MatrixXd effect_of_directions() const;
  bool displace(const Eigen::Matrix4Xd& u);
  void move_boundaries(const Eigen::VectorXd& along);
  void set_quantities(const Quantities& q);
  void integrate_all(bool with_forces);
  void measure_forces(double time);
  void find_multipliers(double time);
  void find_velocities(double time);
  void push_films_apart();

  Fourier& fourier_;
  SurfaceModuli ld_, lo_; ///< with one phase both are the same
  SurfaceTerms more_;
  SurfaceEnergy energy_;
  SurfaceEnergy::Stiffness stiffness_;
  bool energy_is_curved_ = true; // the phases have their spontaneous curvatures
  Film film_;
  Constraints constraints_;
  std::optional<Phases> phases_;
  std::optional<StretchField> stretch_;
  std::vector<CarriedField> materials_;
  LevelSet phi_;
  NarrowBand band_;
  Extension extension_;
  SurfaceGeometry surface_;
  std::optional<LaplacianField> laplacian_; // where the energy needs its derivatives
  Components components_;
  SurfaceIntegrals integrals_;
  std::vector<SurfaceIntegrals> of_each_;
  Eigen::VectorXd lengths_; // of the phase boundary of each vesicle
  Multipliers multipliers_ = Multipliers::Zero(4, 1);
  std::array<Direction, directions> directions_;
  State origin_;                  // of the last measurement
  bool delicate_ = false;         // the constraints, as last seen
  Array<double> field_;           // on the grid; 0 off the band
  std::vector<double> variation_; // F at the samples
  std::vector<double> work_;
  double film_energy_ = 0, most_film_pressure_ = 0, max_force_ = 0, max_speed_ = 0;
};

template <class Displacement>
Eigen::Matrix4Xd Vesicle::moments(Displacement&& u) const {
  Eigen::Matrix4Xd sum = Eigen::Matrix4Xd::Zero(4, components_.count());
  for (std::size_t i = 0; i < surface_.size(); i++) {
    const double w = surface_.weight()[i] * u(i), KM = surface_.KM()[i];
    sum.col(components_.of_sample(i)) +=
        w * Eigen::Vector4d(1, KM, surface_.K()[i], phases_ ? phases_->share()[i] * KM : 0);
  }
  return sum;
}

} // namespace lamella
