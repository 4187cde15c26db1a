#pragma once
#include "geometry/surface_geometry.h"

#include <Eigen/Core>

#include <span>

namespace lamella {

/// Integrals over the membrane that measures and multipliers are made of. The four functions 1,
/// K_M, K, q K_M of the surface (q the share of Ld) are what the multipliers push along; without
/// phases the last is left 0.
struct SurfaceIntegrals {
  Eigen::Matrix4d gram = Eigen::Matrix4d::Zero();      ///< int g_i g_j dA, g = (1, K_M, K, q K_M)
  Eigen::Vector3d variation = Eigen::Vector3d::Zero(); ///< int g_i F dA, F the energy's variation
  double volume = 0;                                   ///< 1/3 int p.N dA
  double area_Ld = 0;                                  ///< of the Ld phase

  double area() const { return gram(0, 0); }
  double int_KM() const { return gram(0, 1); }
  double int_K() const { return gram(0, 2); }
  double int_KM2() const { return gram(1, 1); }

  SurfaceIntegrals& operator+=(const SurfaceIntegrals& other);
};

/// The samples of a membrane, or those of a part of it.
class Samples {
public:
  Samples() = default;
  explicit Samples(std::span<const int> some) : some_(some), all_(false) {}
  std::size_t count(const SurfaceGeometry& surface) const {
    return all_ ? surface.size() : some_.size();
  }
  std::size_t operator[](std::size_t j) const { return all_ ? j : std::size_t(some_[j]); }

private:
  std::span<const int> some_;
  bool all_ = true;
};

/// F at the samples, and how much of it is stiffness Lap_s K_M. Of that part the integrals with 1
/// and K_M are those of first derivatives of K_M, 0 and -stiffness int |grad_s K_M|^2 dA: as sums
/// of second ones they scatter, and tensions with them by 1e-3.
struct Variation {
  std::span<const double> values; ///< empty leaves those integrals 0
  double stiffness = 0;
};

SurfaceIntegrals integrate(const SurfaceGeometry& surface, const Variation& variation,
                           const Samples& samples = {});

} // namespace lamella
