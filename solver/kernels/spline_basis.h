#pragma once
#include "kernels/vec8.h"

namespace lamella::LAMELLA_ISA {

/// Degree-7 B-spline, piecewise: tap k (k = 0..7) is the coefficient at node offset k - 3 from the
/// cell, and weighs sum_m c[m][k] t^m at position t in [0, 1) of the cell. Built by the recurrence
/// B_j^n(t) = [(t + n - j) B_{j-1}^{n-1} + (j + 1 - t) B_j^{n-1}] / n.
struct SplineBasis {
  alignas(64) double c[8][8];

  constexpr SplineBasis() : c{} {
    double b[8][9][8] = {}; // b[n][j][m]: degree n, piece j, power m
    b[0][0][0] = 1;
    for (int n = 1; n < 8; n++)
      for (int j = 0; j <= n; j++)
        for (int m = 0; m <= n; m++) {
          double s = 0;
          if (j > 0) s += (n - j) * b[n - 1][j - 1][m] + (m ? b[n - 1][j - 1][m - 1] : 0);
          if (j < n) s += (j + 1) * b[n - 1][j][m] - (m ? b[n - 1][j][m - 1] : 0);
          b[n][j][m] = s / n;
        }
    for (int m = 0; m < 8; m++)
      for (int k = 0; k < 8; k++) c[m][k] = b[7][k][m];
  }
};
constexpr SplineBasis basis;

/// Taps of the derivatives 0..Order at position t of the cell, in units of 1 / spacing^d.
template <int Order>
LAMELLA_INLINE void spline_weights(double t, double inv_h, double (*w)[8]) {
  for (int part = 0; part < 8; part += width) {
    Part p[8];
    for (int m = 0; m < 8; m++) p[m] = load_part(&basis.c[m][part]);
    double scale = 1;
#pragma GCC unroll 5
    for (int d = 0; d <= Order; d++) {
      Part r = p[7];
#pragma GCC unroll 8
      for (int m = 6; m >= d; m--) r = r * t + p[m];
      *reinterpret_cast<PartAnywhere*>(&w[d][part]) = r * scale;
      scale *= inv_h;
#pragma GCC unroll 8
      for (int m = 7; m > d; m--) p[m] *= double(m - d);
    }
  }
}

/// Symbol of the spline at the nodes: f_i = sum_m fir[|m|] c_{i+m}.
constexpr double fir[4] = {2416. / 5040, 1191. / 5040, 120. / 5040, 1. / 5040};

/// Cell of a point and its position in it.
struct Cell {
  int base[3]; // node just below the point
  double t[3];
};
LAMELLA_INLINE Cell cell_of(const SplineView& s, const double* p) {
  Cell c;
  for (int d = 0; d < 3; d++) {
    const double r = (p[d] - s.origin[d]) * s.inv_spacing, f = __builtin_floor(r);
    c.base[d] = int(f);
    c.t[d] = r - f;
  }
  return c;
}

/// Rows of coefficients around a cell: tap i of row (j, k) is data[k stride_z + j stride_y + i].
struct Stencil {
  const double* data;
  std::size_t stride_y, stride_z;
};

/// The Taps^3 coefficients around the cell; near the side of the box they are copied, wrapped, to
/// `buffer`.
template <int Taps>
LAMELLA_INLINE Stencil stencil_of(const SplineView& s, const Cell& cell, double* buffer) {
  int b[3];
  bool inside = true;
  for (int d = 0; d < 3; d++) {
    b[d] = cell.base[d] - (Taps / 2 - 1);
    inside = inside && b[d] >= 0 && b[d] + Taps <= s.nodes[d];
  }
  const std::size_t nx = s.nodes[0], nxy = nx * s.nodes[1];
  if (inside) return {s.coefficients + b[2] * nxy + b[1] * nx + b[0], nx, nxy};
  int wrapped[3][Taps];
  for (int d = 0; d < 3; d++)
    for (int i = 0; i < Taps; i++) {
      const int m = (b[d] + i) % s.nodes[d];
      wrapped[d][i] = m < 0 ? m + s.nodes[d] : m;
    }
  for (int k = 0; k < Taps; k++)
    for (int j = 0; j < Taps; j++)
      for (int i = 0; i < Taps; i++)
        buffer[(k * Taps + j) * Taps + i] =
            s.coefficients[wrapped[2][k] * nxy + wrapped[1][j] * nx + wrapped[0][i]];
  return {buffer, Taps, std::size_t(Taps) * Taps};
}

} // namespace lamella::LAMELLA_ISA
