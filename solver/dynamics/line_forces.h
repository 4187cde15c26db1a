#pragma once
#include "energy/line.h"
#include "energy/smeared_step.h"
#include "geometry/boundary_feet.h"
#include "levelset/level_set.h"

#include <memory>
#include <span>
#include <vector>

namespace lamella {

/// The energy of the phase boundary, but for its tension and geodesic modulus, which the strip has
/// smeared by itself, and its forces: found on the curve, and spread over a few grid spacings for
/// the membrane.
///
/// A couple makes the membrane's curvature jump. Smeared over the strip, with a jump as wide, the
/// membrane turns too far at the boundary. So what the boundary's energy takes for the membrane's
/// normal there is its mean over the strip, weighted as the couple is spread: then force and couple
/// are the variation of the energy, which does not feel the width of the strip to first order.
class LineForces {
public:
  /// `parameters`: of the density as text.
  LineForces(const Line& moduli, const Parameters& parameters, double spacing);

  /// Where all moduli are 0 and there is no text, all below is 0.
  bool exist() const { return exist_; }
  /// Of the strip that forces are spread over.
  double half_width() const { return profile_.half_width(); }
  /// At all points of a boundary on the membrane phi = 0.
  void find(const PhaseBoundary& boundary, const LevelSet& phi);
  /// oint l dl of a part of the density, with the boundary as last found.
  double energy(const LineDensity& part, const PhaseBoundary& boundary) const;
  /// The part that is given as text; null: none.
  const LineDensity* text() const { return text_.get(); }
  /// Along n, per length.
  double along_boundary(std::size_t point) const { return along_n_[point]; }
  /// A sample in the strip, of which the foot is known.
  struct Place {
    BoundaryFeet::Foot foot;
    double psi, slope2, lap; ///< |grad_s psi|^2, Lap_s psi
    double weight;           ///< area
  };
  /// Of the membrane's energy with a normal displacement, per area, at the places of the strip.
  std::vector<double> variation(const PhaseBoundary& boundary, std::span<const Place> places) const;
  /// About the most that variation() comes to.
  double greatest() const { return greatest_; }

  /// Force per length of waves of the boundary that are k in number a radian and 1 high: of the
  /// boundary itself, stiffness k^4 + tension k^2.
  struct Stiffness {
    double stiffness = 0, tension = 0;
  };
  Stiffness of_boundary() const { return of_boundary_; }
  /// The same of the membrane, per area.
  Stiffness of_membrane() const { return of_membrane_; }

private:
  void find_ribbon(const PhaseBoundary& boundary, const LevelSet& phi);
  void find_stiffness();
  void balance(const PhaseBoundary& boundary, std::size_t curve, std::span<const Place> places,
               std::span<double> variation) const;

  bool exist_;
  double h_;
  std::shared_ptr<const LineDensity> text_, density_;
  SmearedStep profile_, of_couples_;
  std::vector<CurveGeometry> ribbon_; // B_perp the mean of the strip
  std::vector<double> along_n_, along_N_, couple_;
  double greatest_ = 0;
  Stiffness of_boundary_, of_membrane_;
};

} // namespace lamella
