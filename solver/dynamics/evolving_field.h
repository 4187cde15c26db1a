#pragma once
#include "dynamics/semi_implicit.h"
#include "levelset/level_set.h"
#include "levelset/smooth_fit.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lamella {

/// A scalar on the membrane that a run carries along with it: phases, lipid, material fields. It is
/// a spline in the box that hardly changes along the membrane's normals, with steps of its own.
class EvolvingField {
public:
  /// `name`: of its array in frames. The transform has to outlast the field.
  EvolvingField(std::string name, const Grid& grid, Fourier& fourier);

  const std::string& name() const { return name_; }
  LevelSet& spline() { return spline_; }
  const LevelSet& spline() const { return spline_; }
  /// From nodal values, see LevelSet::fit.
  void fit(std::span<const double> nodal, int sweeps);
  /// From coefficients.
  void restore(std::span<const double> coefficients);
  /// What makes coefficients of corrections.
  const SmoothFit& corrections() const { return corrections_; }

  /// Made when a step first asks for it; null before.
  SemiImplicit& stepper();
  const SemiImplicit* stepper_if_made() const { return stepper_ ? &*stepper_ : nullptr; }
  /// For steps that are none of the stepper's: what go_back() leads to.
  void keep();
  /// To what it was before the last step.
  void go_back();
  void restart();
  /// The box moved by so many cells.
  void shift(const std::array<int, 3>& cells);
  /// At the nodes, now or as it was before the last step.
  std::vector<double> nodal(bool before) const;

private:
  std::span<const double> before() const;

  std::string name_;
  Fourier* fourier_;
  LevelSet spline_;
  SmoothFit corrections_;
  std::optional<SemiImplicit> stepper_;
  Array<double> kept_;
};

} // namespace lamella
