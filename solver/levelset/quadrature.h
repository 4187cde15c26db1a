#pragma once

namespace lamella {

/// Surface integrals as sums over band nodes: int f dA = sum over nodes of weight(d) f(p), with p
/// the node's nearest point and d its signed distance.
///
/// The kernel is an "exponential of semicircle" (Barnett, Magland, af Klinteberg, SIAM J. Sci.
/// Comput. 41 (2019) C479) on d/h in [begin, end]: its Fourier transform is negligible at the
/// reciprocal lattice, so the sum aliases by about 1e-5 of a planar patch and far less on curved
/// ones. It lies outside because the inside of a thin rim is the first place where nearest points
/// cease to be unique; the Steiner factor 1 - d K_M + d^2 K of the offset surface makes up for the
/// shift. Where the membrane bends around the outside more sharply than that, at a neck, the kernel
/// ends before the focal point and aliases more.
struct QuadratureKernel {
  static constexpr double begin = -1, end = 3; // spacings

  /// All lengths in the same unit; h is the spacing.
  static double weight(double d, double KM, double K, double h);
};

} // namespace lamella
