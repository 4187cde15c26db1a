#pragma once
#include "dynamics/evolving_field.h"
#include "energy/surface_jet.h"
#include "geometry/surface_geometry.h"
#include "levelset/extension.h"
#include "scene/scene.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lamella {

/// A field that the membrane takes along, point by point as they move along their normals. Each
/// point keeps its value; or what there is of something keeps its amount, and the field, its
/// amount per area, falls where the membrane grows: m_t = m K_M v.
class CarriedField {
public:
  /// Everywhere 0.
  CarriedField(std::string name, Carried carried, const Grid& grid, Fourier& fourier);

  EvolvingField& evolving() { return field_; }
  const EvolvingField& evolving() const { return field_; }
  const LevelSet& spline() const { return field_.spline(); }
  Carried carried() const { return carried_; }

  /// Finds the field and its derivatives at the samples (what forces need of the membrane is
  /// known).
  void sample(const SurfaceGeometry& surface);
  /// At the samples.
  std::span<const SurfaceJet<double>> jets() const { return jets_; }
  /// What carrying an amount along changes the field by per time at a sample, where the normal
  /// velocity is v.
  double rate(std::size_t sample, double KM, double v) const { return jets_[sample].f * KM * v; }
  /// Makes the field constant along normals again, where the membrane moved through it, and puts
  /// back what was lost or gained of an amount on the way.
  void extend(const NarrowBand& band, const SurfaceGeometry& surface, Extension& extension);

  /// int m dA as it was at the start; 0 where it is not kept.
  double amount() const { return amount_.value_or(0); }
  /// Goes on from stored coefficients and their amount().
  void restore(std::span<const double> coefficients, double amount);

private:
  Carried carried_;
  EvolvingField field_;
  std::vector<SurfaceJet<double>> jets_;
  std::vector<double> off_;
  std::optional<double> amount_; // once it is known, where it is kept
};

} // namespace lamella
