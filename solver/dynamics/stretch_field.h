#pragma once
#include "dynamics/carried_field.h"
#include "dynamics/measures.h"
#include "energy/stretch_energy.h"
#include "geometry/surface_geometry.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace lamella {

/// The local stretch of a membrane: a field c, lipid per area over its rest value, whose amount
/// moves with the membrane. Its tension sigma_c makes the membrane flow along itself, v_s = grad_s
/// sigma_c, and pulls on it as any tension does.
class StretchField {
public:
  /// 1 everywhere.
  StretchField(double modulus, const Grid& grid, Fourier& fourier);

  CarriedField& c() { return c_; }
  const CarriedField& c() const { return c_; }

  /// Adds -sigma_c K_M to the variation; c is known at the samples.
  void add_variation(const SurfaceGeometry& surface, std::span<double> variation) const;
  /// n.grad_s sigma_c at points of the membrane: what the flow carries a line along.
  std::vector<double> flow_across(std::span<const Eigen::Vector3d> points,
                                  std::span<const Eigen::Vector3d> n) const;

  /// d c/dt at a sample whose normal velocity is v: from c_t + div_s(c (v + v_s)) = 0.
  double rate(std::size_t sample, double KM, double v) const;

  StretchMeasures measures(const SurfaceGeometry& surface) const;
  double energy(const SurfaceGeometry& surface) const;
  const StretchEnergy& law() const { return law_; }

private:
  StretchEnergy law_;
  CarriedField c_;
};

} // namespace lamella
