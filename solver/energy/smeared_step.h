#pragma once
#include <array>

namespace lamella {

/// A step from 0 to 1 across the phase boundary, smeared over a few grid spacings so that a smooth
/// level set can carry the forces that live on the boundary: delta(x) is their profile.
class SmearedStep {
public:
  static constexpr int terms = 10; ///< of the profiles, in even powers

  /// The profile that leaves energies as a sharp boundary has them. A line force f bends the
  /// membrane by itself, with an energy -f^2 / (24 kappa) E|x - y|^3 a length, x and y distributed
  /// as delta; a linear field over it feels E x^2. Both moments are 0 here (delta is negative
  /// towards its ends), so that energies err by the fifth power of the width and not by the second.
  static SmearedStep accurate(double half_width);
  /// The profile for a jump of moment m, as a jump of the Gaussian modulus makes: the membrane
  /// answers with the energy -m^2 / (4 kappa) E|x - y|, a moment that is a third of the one above
  /// here. (Without it altogether the profile swings so much that steps get short.)
  static SmearedStep of_moments(double half_width);
  /// Profiles for forces and couples that are known on the boundary only. Their seventh derivatives
  /// are the first that jump: quadrature of couples, which swing to and fro across the boundary,
  /// errs by a tenth or less of what it does with the profiles above. That for couples has E|x - y|
  /// = 0 besides.
  static SmearedStep of_line_forces(double half_width);
  static SmearedStep of_line_couples(double half_width);
  /// A step that never leaves [0, 1], for moduli that must stay between those of the phases: errs
  /// by the second power of the width.
  static SmearedStep monotonic(double half_width);

  struct Value {
    double step, delta, slope, bend; ///< H and its first three derivatives
  };
  /// At a signed distance x from the boundary.
  Value at(double x) const;
  double half_width() const { return half_width_; }

private:
  SmearedStep(double half_width, int power, double quartic);
  SmearedStep(double half_width, const std::array<double, terms>& even);

  double half_width_;
  std::array<double, terms> even_; ///< delta(u) = sum even_[j] u^2j on [-1, 1]
};

} // namespace lamella
