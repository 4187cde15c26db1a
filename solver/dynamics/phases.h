#pragma once
#include "dynamics/evolving_field.h"
#include "dynamics/held_areas.h"
#include "dynamics/line_forces.h"
#include "dynamics/measures.h"
#include "dynamics/stretch_field.h"
#include "energy/surface_energy.h"
#include "geometry/boundary_feet.h"
#include "geometry/surface_geometry.h"
#include "levelset/domains.h"
#include "levelset/extension.h"
#include "levelset/level_set.h"
#include "levelset/taylor.h"
#include "scene/scene.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace lamella {

/// Integrals over the membrane that the phases add; q = 1 in Ld, 0 in Lo, smooth across the
/// boundary.
struct PhaseIntegrals {
  Eigen::Vector4d gram = Eigen::Vector4d::Zero(); ///< int q K_M (1, K_M, K, q K_M) dA
  double area_Ld = 0, length = 0;

  PhaseIntegrals& operator+=(const PhaseIntegrals& other);
};

/// The two lipid phases of a membrane: Ld = {psi < 0} and Lo = {psi > 0}, where they meet, and what
/// that does to both.
///
/// The boundary is seen in two ways. As polylines it has its own geometry, feels the force along
/// the membrane and tells the distance from it. For the membrane it is a strip of a few spacings in
/// which moduli change smoothly and the line force is spread: functions of psi, varied exactly, so
/// that jumps of moment and couple at the boundary come about by themselves.
class Phases {
public:
  Phases(const Scene& scene, std::span<const double> psi, Fourier& fourier);

  /// Finds the boundary on a membrane that moved, and brings psi back towards the distance from it.
  void locate(const LevelSet& phi, const NarrowBand& band, const Components& vesicles);
  /// The same after small changes, with the boundary that is known.
  void follow(const LevelSet& phi, const NarrowBand& band);
  /// Finds the phases of the samples: all that integrals of the phases need.
  void sample(const NarrowBand& band, const SurfaceGeometry& surface, const Components& vesicles);
  /// The variation F of the energy (a normal displacement u changes it by int F u dA) at the
  /// samples, and the force on the boundary. sample() up to date, fourth derivatives and material
  /// fields known.
  void find_forces(const LevelSet& phi, const SurfaceGeometry& surface, SurfaceEnergy& energy,
                   std::span<double> variation, std::span<const CarriedField> fields = {});

  /// Lets the boundary be carried along by the flow of lipid.
  void add_flow(const StretchField& stretch);

  PhaseIntegrals integrate(const SurfaceGeometry& surface, const Samples& samples) const;
  /// Sets those of the boundary; those of the membrane are known.
  void find_line_energies(EnergyTerms& terms) const;

  /// The areas that are held. sample() brings them up to date, find_forces() and add_flow() what
  /// integrate_held() needs.
  HeldAreas& held() { return held_; }
  const HeldAreas& held() const { return held_; }
  HeldAreas::Integrals integrate_held(const SurfaceGeometry& surface,
                                      std::span<const double> variation,
                                      const Components& vesicles) const;

  /// First-order change of the area of Ld of each vesicle where psi changes by so much at the
  /// samples.
  Eigen::VectorXd change_of_area(std::span<const double> psi, const SurfaceGeometry& surface,
                                 const Components& vesicles) const;
  /// Of each vesicle's boundary.
  Eigen::VectorXd length(const SurfaceGeometry& surface, const Components& vesicles) const;

  /// Whether samples are in Ld, as of the last find_forces().
  std::span<const char> is_Ld() const { return is_Ld_; }
  /// Share of Ld, 1 - H, at the samples.
  std::span<const double> share() const { return share_; }
  /// delta(psi) |grad_s psi| at the samples: int f delta dA = oint f dl.
  std::span<const double> delta() const { return delta_; }

  /// Rates of psi at which the boundary moves in a step, carried into the box.
  void extend_rates(const NarrowBand& band, double dt, Extension& extension);
  /// By what share the next locate() lets strips fade that a boundary left where it vanished; found
  /// by extend_rates(), as it takes time.
  double fade() const { return fade_; }
  void set_fade(double fade) { fade_ = fade; }

  /// As of the last locate().
  const std::vector<Domain>& domains() const { return domains_; }
  /// Length / 2 pi of the shortest closed boundary; 0 where there is none.
  double least_radius() const;
  /// 1 at nodes on the boundary, falling smoothly to 0 several spacings from it.
  double near_boundary(int node) const;

  EvolvingField& evolving() { return field_; }
  const EvolvingField& evolving() const { return field_; }
  LevelSet& psi() { return field_.spline(); }
  const LevelSet& psi() const { return field_.spline(); }
  const PhaseBoundary& boundary() const { return boundary_; }
  const BoundaryFeet& feet() const { return feet_; }
  /// On the boundary along n, per length, without the jump of tension.
  std::span<const double> force() const { return force_; }
  /// Of the boundary along n: with its force less the jump of tension, and with the flow of lipid.
  double speed(std::size_t point) const {
    return (force_[point] - held_.jump()[point]) / drag_ + flow_[point];
  }
  double max_line_speed() const;
  /// In which a bump of the boundary of the size of the grid relaxes.
  double relaxation_time() const { return drag_ / stiffness_; }
  /// Of the boundary along the membrane, per length.
  double drag() const { return drag_; }
  void set_drag(double drag) { drag_ = drag; }
  const Line& line() const { return line_; }
  const LineForces& line_forces() const { return line_forces_; }
  /// Spontaneous curvatures are 0 before.
  double curvature_start_time() const { return curvature_start_time_; }
  bool is_curved(double time) const { return time >= curvature_start_time_ * (1 - 1e-12); }
  /// Of both phases.
  SurfaceEnergy surface_energy(double time) const;

private:
  /// A sample in the strip along the boundary.
  struct StripPoint {
    int sample = 0;
    Taylor psi{0, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};
    double slope2 = 0; ///< |grad_s psi|^2
    double lap = 0;    ///< Lap_s psi
    BoundaryFeet::Foot foot;
  };

  void find_further(const SurfaceGeometry& surface);
  void add_line_forces(const SurfaceGeometry& surface, std::span<double> variation) const;
  void restore_distance(const NarrowBand& band);
  void find_boundary_force(const LevelSet& phi, std::span<const CarriedField> fields,
                           const SurfaceEnergy& energy);
  void spread_line_forces(const SurfaceGeometry& surface, std::span<double> variation) const;
  double saturated(double s) const;
  double boundary_taper(double s) const;

  double h_;
  double drag_ = 1;
  double stiffness_ = 0; // of the boundary on a membrane at rest: force per length and displacement
  SurfaceModuli ld_, lo_;
  double curvature_start_time_;
  Parameters parameters_;
  MaterialFields fields_;
  Line line_;
  LineForces line_forces_;
  StepProfiles profiles_;
  HeldAreas held_;
  double fade_ = 0;
  EvolvingField field_;
  PhaseBoundary boundary_;
  BoundaryFeet feet_; // of the band's entries
  std::vector<Domain> domains_;
  std::vector<StripPoint> strip_;
  SurfaceEnergy::Strip jets_;
  std::vector<char> is_Ld_; // at the samples
  std::vector<double> share_, delta_;
  std::vector<double> force_, flow_; // along n, at the boundary's points
  std::vector<double> rates_, weights_;
};

} // namespace lamella
