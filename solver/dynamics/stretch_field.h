#pragma once
#include "dynamics/measures.h"
#include "energy/stretch_energy.h"
#include "geometry/surface_geometry.h"
#include "levelset/extension.h"
#include "levelset/level_set.h"
#include "levelset/smooth_fit.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace lamella {

/// The local stretch of a membrane: a field c, lipid per area over its rest value, that moves with
/// the membrane. Its tension sigma_c makes the membrane flow along itself, v_s = grad_s sigma_c,
/// and pulls on it as any tension does.
class StretchField {
public:
  /// `c`: nodal values; empty: 1 everywhere.
  StretchField(double modulus, const Grid& grid, std::span<const double> c, Fourier& fourier);

  /// Finds c and its derivatives at the samples (normals and curvatures known).
  void sample(const SurfaceGeometry& surface);
  /// Adds -sigma_c K_M to the variation.
  void add_variation(const SurfaceGeometry& surface, std::span<double> variation) const;
  /// n.grad_s sigma_c at points of the membrane: what the flow carries a line along.
  std::vector<double> flow_across(std::span<const Eigen::Vector3d> points,
                                  std::span<const Eigen::Vector3d> n) const;

  /// d c/dt at a sample whose normal velocity is v: from c_t + div_s(c v) = 0.
  double rate(std::size_t sample, double KM, double v) const;
  /// Makes c constant along normals again, where the membrane moved through it, and puts the lipid
  /// back that was lost or gained on the way.
  void extend(const NarrowBand& band, const SurfaceGeometry& surface, Extension& extension);

  StretchMeasures measures(const SurfaceGeometry& surface) const;
  double energy(const SurfaceGeometry& surface) const;
  const StretchEnergy& law() const { return law_; }
  /// int c dA as it was at the start; 0: not known yet.
  double lipid() const { return lipid_; }
  /// Goes on from stored coefficients of c and their lipid().
  void restore(std::span<const double> c, double lipid);
  LevelSet& c() { return c_; }
  const LevelSet& c() const { return c_; }

private:
  double integral(const SurfaceGeometry& surface) const;

  StretchEnergy law_;
  SmoothFit fit_;
  LevelSet c_;
  std::vector<double> value_, lap_, slope2_; // at the samples: c, Lap_s c, |grad_s c|^2
  std::vector<double> off_;
  double lipid_ = 0;
};

} // namespace lamella
