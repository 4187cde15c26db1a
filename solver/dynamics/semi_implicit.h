#pragma once
#include "levelset/extension.h"
#include "levelset/level_set.h"

#include <complex>
#include <vector>

namespace lamella {

/// How stiff the bending force is taken to be: the implicit symbol is stiffness k^4 + tension k^2.
struct ImplicitSymbol {
  double stiffness = 1; ///< bending modulus
  double tension = 0;   ///< >= 0
};

/// Advances phi by d phi / dt = rate with the stiff part implicit: a blend, mode by mode, of SBDF2 (where
/// z = dt (stiffness k^4 + tension k^2) is small) and semi-implicit Euler (where it is large), with variable
/// steps, in one Fourier transform pair. The blend is stable while the true symbol is below twice the
/// implicit one; SBDF2 alone needs 4/3, and Euler alone is first order.
class SemiImplicit {
public:
  SemiImplicit(const Grid& grid, Fourier& fourier);

  /// c += increment; `rates` gives nodal rates plane by plane.
  void advance(LevelSet& phi, const Extension& rates, double dt, const ImplicitSymbol& symbol);

  /// Coefficient increments of the last step, and of the one before it, at the nodes.
  std::span<const double> increment() const { return increment_; }
  std::span<const double> previous_increment() const { return previous_; }
  /// Coefficients before the last step: what to go back to when it went wrong.
  std::span<const double> before() const { return before_; }
  /// Last step over the one before; 0 where there is no history.
  double step_ratio() const { return ratio_; }
  double last_dt() const { return last_dt_; }

  /// phi was multiplied by `factor`.
  void rescale(double factor);
  /// The next step is Euler.
  void forget() { last_dt_ = 0; }

private:
  Grid grid_;
  Fourier& fourier_;
  std::vector<double> kx2_, inv_symbol_x_; // each number twice: real and imaginary part
  std::vector<double> k2_[2], symbol_[2];  // along y and z
  Array<std::complex<double>> rate_, spectral_increment_;
  Array<double> increment_, previous_, before_;
  double last_dt_ = 0, ratio_ = 0;
};

} // namespace lamella
