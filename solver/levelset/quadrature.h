#pragma once

namespace lamella {

/// Surface integrals as sums over band nodes: int f dA = sum over nodes of weight(d) f(p), with p
/// the node's nearest point and d its signed distance.
///
/// The kernel is an "exponential of semicircle" (Barnett, Magland, af Klinteberg, SIAM J. Sci.
/// Comput. 41 (2019) C479) on d/h in [begin, end]: its Fourier transform is small at the reciprocal
/// lattice, so the sum aliases, four spacings wide, by about 1e-5 of a planar patch, and the wider
/// the kernel the less. The Steiner factor 1 - d K_M + d^2 K of the offset surface makes up for d.
/// Beyond a focal point, where the membrane bends sharply, nearest points are not unique: there the
/// kernel ends, down to one spacing from the membrane, and aliases more.
struct QuadratureKernel {
  double begin, end; ///< spacings
  double least;      ///< spacings inside that it reaches however sharply the membrane is bent

  /// Mostly outside: the inside of a thin rim is the first place where nearest points cease to be
  /// unique. (From -1 on, energies at rest scattered by 1e-5 with the grid, as the area does that
  /// is held.)
  static constexpr QuadratureKernel outside() { return {-1.8, 3, 1}; }
  /// For membranes with a phase boundary. In the groove along it the normals meet outside, at 4
  /// spacings in a bulged cap at 64^3, and what changes quickly across the boundary is squeezed
  /// together there: the length of the boundary, smeared over 5 spacings, scattered by 0.7 % with
  /// its place between the nodes, with this kernel by 0.07 %.
  static constexpr QuadratureKernel symmetric() { return {-2, 2, 2}; }

  /// For a membrane whose greatest curvature outwards is `bend`, over the spacing: in rims the
  /// kernel reaches two thirds of the way to where nearest points cease to be unique. One for the
  /// whole membrane: where it changed from node to node, sums erred by 1e-3 at a rim of 1.5
  /// spacings.
  QuadratureKernel reaching(double bend) const;

  /// All lengths in the same unit; h is the spacing.
  double weight(double d, double KM, double K, double h) const;
};

} // namespace lamella
