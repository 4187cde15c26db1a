#pragma once
#include "dynamics/evolving_field.h"
#include "energy/surface_jet.h"
#include "geometry/surface_geometry.h"
#include "levelset/extension.h"
#include "scene/scene.h"

#include <functional>
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
  /// back what was lost or gained of an amount on the way. On the membrane itself it stays as it
  /// is; or, with `smoothing`, loses a little of what is as short as the grid.
  void extend(const NarrowBand& band, const SurfaceGeometry& surface, Extension& extension,
              bool smoothing);

  /// int m dA as it was at the start; 0 where it is not kept.
  double amount() const { return amount_.value_or(0); }
  /// Goes on from stored coefficients and their amount().
  void restore(std::span<const double> coefficients, double amount);

  /// Values that a function of place has on the membrane: a field that starts from them.
  void start(const std::function<double(const Vec3&)>& value, const NarrowBand& band,
             Extension& extension);

private:
  Carried carried_;
  EvolvingField field_;
  std::vector<SurfaceJet<double>> jets_;
  std::optional<double> amount_; // once it is known, where it is kept
};

/// What densities need of material fields.
std::vector<std::span<const SurfaceJet<double>>> jets_of(std::span<const CarriedField> fields);

} // namespace lamella
