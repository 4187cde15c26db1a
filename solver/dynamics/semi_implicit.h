#pragma once
#include "levelset/extension.h"
#include "levelset/level_set.h"

#include <complex>
#include <span>
#include <vector>

namespace lamella {

/// How stiff the force of the membrane is taken to be: the implicit symbol is stiffness k^4 +
/// tension k^2 and, levelled off near the grid, gradient k^6, none of which is negative.
struct ImplicitSymbol {
  double stiffness = 1; ///< bending modulus
  double tension = 0;
  double gradient = 0; ///< twice the gradient modulus
};

/// Advances phi by d phi / dt = rate with the stiff part implicit: a blend, mode by mode, of SBDF2
/// (where z, dt times the implicit symbol, is small) and semi-implicit Euler (where it is
/// large), with variable steps. Stiff modes keep a share of SBDF2's history, which cuts their lag:
/// with 0.3 by a third, and stable while the true symbol is below 1.6 times the implicit one (Euler
/// alone: 2, SBDF2 alone: 4/3).
///
/// A step is made of predict(), respond() and apply(), in this order.
class SemiImplicit {
public:
  static constexpr double blend = 1; ///< modes with z above it are mostly Euler
  /// Of SBDF2, for stiff modes too, where nothing tells better.
  static constexpr double share_of_history = 0.3;
  /// The stiffest modes, z above it, where stability is marginal, lose that too.
  static constexpr double fade = 30;

  struct Response {
    Array<std::complex<double>> modes; ///< of the coefficients
    Array<double> nodal;               ///< coefficients at the nodes
  };
  /// What the next step takes from those before.
  struct Memory {
    double dt = 0;                               ///< of the last step; 0: there is no history
    Array<std::complex<double>> rate, increment; ///< of the last step, in Fourier space
    Array<double> nodal_increment;               ///< the same increment at the nodes
    std::vector<Response> responses;
    double last_factor = 0; ///< of the first response, still missing in `increment`
  };

  /// `responses`: to how many constraint forces.
  SemiImplicit(const Grid& grid, Fourier& fourier, int responses);

  /// Coefficient increment of a step of length dt at the given nodal rates; stiff modes keep
  /// `share` of the history.
  void predict(const Extension& rates, double dt, const ImplicitSymbol& symbol,
               double share = share_of_history);

  /// What constraint force `which` does in the same step: its nodal rates, smoothed as the step
  /// smooths. Constraints that are kept along this response, and not along the force itself, do not
  /// work against the step.
  void respond(int which, const Extension& rates);

  /// c += increment + sum of factor response + constant; the sum is the increment that the next
  /// step remembers.
  void apply(LevelSet& phi, std::span<const double> factors, double constant);

  /// The same with an increment of its own, smoothed as responses are, in place of factors and a
  /// constant: that of nodal rates over a time.
  void apply(LevelSet& phi, const Extension& rates, double time);

  /// Coefficients at the nodes: of the step under way from predict() on, of the last step after
  /// apply().
  std::span<const double> increment() const { return memory_.nodal_increment; }
  std::span<const double> response(int which) const { return memory_.responses[which].nodal; }
  /// Of the step before.
  std::span<const double> previous_increment() const { return previous_; }
  /// Coefficients before the last apply(): what to go back to when the step went wrong.
  std::span<const double> before() const { return before_; }
  /// This step over the one before; 0 where there is no history.
  double step_ratio() const { return ratio_; }

  /// phi was multiplied by `factor`.
  void rescale(double factor);

  /// The box moved by so many cells: what was kept follows.
  void shift(const std::array<int, 3>& cells);

  /// Forgets the steps before: phi was changed by other means.
  void restart() { memory_.dt = 0; }

  const Memory& memory() const { return memory_; }
  /// Goes on as the stepper that had this memory, on the same grid with as many responses.
  void remember(Memory memory) { memory_ = std::move(memory); }

private:
  SpectralRow row(int ky, int kz) const;

  Grid grid_;
  Fourier& fourier_;
  std::vector<double> none_;               // a row of no correction
  std::vector<double> kx2_, inv_symbol_x_; // each number twice: real and imaginary part
  std::vector<double> k2_[2], symbol_[2];  // along y and z
  Memory memory_;
  Array<double> previous_, before_;
  ImplicitSymbol implicit_;
  double ratio_ = 0, share_ = share_of_history;
};

} // namespace lamella
