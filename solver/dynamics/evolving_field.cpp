#include "dynamics/evolving_field.h"

#include <algorithm>
#include <utility>

namespace lamella {

EvolvingField::EvolvingField(std::string name, const Grid& grid, Fourier& fourier)
    : name_(std::move(name)), fourier_(&fourier), spline_(grid), corrections_(grid, fourier) {}

void EvolvingField::fit(std::span<const double> nodal, int sweeps) {
  restore(nodal);
  spline_.fit(nodal, *fourier_, sweeps);
}

void EvolvingField::restore(std::span<const double> coefficients) {
  std::ranges::copy(coefficients, spline_.coefficients().begin());
}

SemiImplicit& EvolvingField::stepper() {
  if (!stepper_) stepper_.emplace(spline_.grid(), *fourier_, 0);
  return *stepper_;
}

void EvolvingField::keep() {
  kept_.assign(spline_.coefficients().begin(), spline_.coefficients().end());
}

std::span<const double> EvolvingField::before() const {
  if (stepper_) return stepper_->before();
  return kept_.empty() ? spline_.coefficients() : kept_;
}

void EvolvingField::go_back() { restore(before()); }

void EvolvingField::restart() {
  if (stepper_) stepper_->restart();
}

void EvolvingField::shift(const std::array<int, 3>& cells) {
  lamella::shift(spline_.grid(), cells, spline_.coefficients());
  if (stepper_) stepper_->shift(cells);
}

std::vector<double> EvolvingField::nodal(bool before_step) const {
  std::vector<double> values(spline_.grid().size());
  nodal_values(spline_.grid(), before_step ? before() : spline_.coefficients(), values);
  return values;
}

} // namespace lamella
