#pragma once
#include "dynamics/constraints.h"
#include "dynamics/measures.h"
#include "dynamics/start.h"
#include "dynamics/surface_integrals.h"
#include "energy/film.h"
#include "energy/helfrich.h"
#include "geometry/surface_geometry.h"
#include "levelset/extension.h"
#include "levelset/level_set.h"

#include <array>
#include <span>
#include <vector>

namespace lamella {

/// The membrane of a vesicle at one time: its level set, its samples, the forces on it, and the
/// constraints that it is on.
class Vesicle {
public:
  Vesicle(const Scene& scene, const Start& start, Fourier& fourier);

  /// Finds everything that is known of the membrane after phi changed a little, having brought it
  /// onto its constraints at a time. Returns how far off them it was.
  Quantities measure(double time);
  /// The same after phi was changed by other means than a step. Returns the area before the
  /// correction.
  double measure_anew(double time);
  /// Lets an area difference that is free until now be held, where it is its time.
  bool set_out(double time);

  /// All terms.
  double energy() const;
  /// All but the step.
  Measures measures(double time) const;
  /// Largest relative deviation from the constraints.
  double drift(double time) const;
  /// Normal velocity at a sample (Eq. 80).
  double velocity(std::size_t sample) const;
  double max_speed() const { return max_speed_; }
  double max_force() const { return max_force_; }
  /// What constraints and films allow.
  double longest_step(double time) const;

  const Grid& grid() const { return phi_.grid(); }
  LevelSet& phi() { return phi_; }
  const LevelSet& phi() const { return phi_; }
  const NarrowBand& band() const { return band_; }
  Extension& extension() { return extension_; }
  const SurfaceGeometry& surface() const { return surface_; }
  const SurfaceIntegrals& integrals() const { return integrals_; }
  const Multipliers& multipliers() const { return multipliers_; }
  const Constraints& constraints() const { return constraints_; }
  const Helfrich& bending() const { return bending_; }
  /// |grad phi| at the nearest points of band entries; 0 where it is not known.
  std::vector<double> grad_of_entries() const;

private:
  /// One way to displace the membrane.
  struct Direction {
    std::vector<double> nodal; ///< change of phi at the band entries, tapered
    std::vector<double> moves; ///< the displacement at the samples
  };

  void locate();
  void lead_to_constraints(double time);
  void set_directions();
  void evaluate_on_membrane(std::span<const double> change, std::vector<double>& moves);
  Eigen::Matrix3d effect_of_directions() const;
  void displace(const Eigen::Vector3d& u);
  void measure_forces(double time);
  void push_films_apart();

  Helfrich bending_;
  Film film_;
  Constraints constraints_;
  LevelSet phi_;
  NarrowBand band_;
  Extension extension_;
  SurfaceGeometry surface_;
  SurfaceIntegrals integrals_;
  Multipliers multipliers_ = Multipliers::Zero();
  std::array<Direction, 3> directions_;
  bool delicate_ = false;         // the constraints, as last seen
  Array<double> field_;           // on the grid; 0 off the band
  std::vector<double> variation_; // F at the samples
  std::vector<double> work_;
  double film_energy_ = 0, most_film_pressure_ = 0, max_force_ = 0, max_speed_ = 0;
};

} // namespace lamella
