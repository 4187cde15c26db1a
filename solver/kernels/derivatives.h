#pragma once
#include "kernels/spline_basis.h"

// Derivatives of the spline at eight points, one point a lane.
namespace lamella::LAMELLA_ISA {

/// Position of the derivative d^(a+b+c) / dx^a dy^b dz^c among those up to Order.
template <int Order>
struct DerivativeIndex {
  static constexpr int pairs = (Order + 1) * (Order + 2) / 2;
  static constexpr int count = (Order + 1) * (Order + 2) * (Order + 3) / 6;
  int pair_y[pairs], pair_z[pairs]; // derivative orders of pair q
  int x[count], pair[count];        // x order and (y, z) pair of slot m
  int slot[Order + 1][Order + 1][Order + 1];

  constexpr DerivativeIndex() : pair_y{}, pair_z{}, x{}, pair{}, slot{} {
    int pair_of[Order + 1][Order + 1] = {};
    int q = 0, m = 0;
    for (int b = 0; b <= Order; b++)
      for (int c = 0; b + c <= Order; c++) {
        pair_y[q] = b;
        pair_z[q] = c;
        pair_of[b][c] = q++;
      }
    for (int a = 0; a <= Order; a++)
      for (int b = 0; a + b <= Order; b++)
        for (int c = 0; a + b + c <= Order; c++) {
          x[m] = a;
          pair[m] = pair_of[b][c];
          slot[a][b][c] = m++;
        }
  }
};
template <int Order>
constexpr DerivativeIndex<Order> derivative_index;

/// The spline contracted along y and z at one point, and the weights that remain to be applied
/// along x.
template <int Order>
struct Contracted {
  V8 rows[DerivativeIndex<Order>::pairs];
  alignas(64) double wx[Order + 1][8];
};

/// Planes whose partial sums fit the registers together.
constexpr int planes_at_once = width == 8 ? 4 : 2;

/// Adds row j of several planes, weighted along y.
template <int Order>
LAMELLA_INLINE void add_rows(const double* data, const Stencil& st, const double (*wy)[8], int j,
                             Part (*sum)[Order + 1]) {
#pragma GCC unroll 4
  for (int k = 0; k < planes_at_once; k++) {
    const Part row = load_part(data + k * st.stride_z + j * st.stride_y);
#pragma GCC unroll 5
    for (int d = 0; d <= Order; d++) sum[k][d] += row * wy[d][j];
  }
}

template <int Order>
LAMELLA_INLINE void contract(const SplineView& s, const double* p, Contracted<Order>& out) {
  constexpr const auto& index = derivative_index<Order>;
  constexpr int planes = planes_at_once;
  const Cell cell = cell_of(s, p);
  alignas(64) double buffer[512];
  const Stencil st = stencil_of<8>(s, cell, buffer);
  alignas(64) double wy[Order + 1][8], wz[Order + 1][8];
  spline_weights<Order>(cell.t[0], s.inv_spacing, out.wx);
  spline_weights<Order>(cell.t[1], s.inv_spacing, wy);
  spline_weights<Order>(cell.t[2], s.inv_spacing, wz);
  // From here on weights are broadcast from memory; the compiler would shuffle and spill registers
  // instead.
  asm volatile("" : : "r"(wy), "r"(wz) : "memory");
#pragma GCC unroll 1
  for (int part = 0; part < parts; part++) {
    Part sum[8][Order + 1];
#pragma GCC unroll 4
    for (int k0 = 0; k0 < 8; k0 += planes) {
      const double* data = st.data + part * width + k0 * st.stride_z;
      Part group[planes][Order + 1] = {};
      if constexpr (Order > 2) { // more sums at once than leave registers for unrolling fully
#pragma GCC unroll 4
        for (int j = 0; j < 8; j++) add_rows<Order>(data, st, wy, j, group);
      } else {
#pragma GCC unroll 8
        for (int j = 0; j < 8; j++) add_rows<Order>(data, st, wy, j, group);
      }
#pragma GCC unroll 4
      for (int k = 0; k < planes; k++)
#pragma GCC unroll 5
        for (int d = 0; d <= Order; d++) sum[k0 + k][d] = group[k][d];
    }
#pragma GCC unroll 15
    for (int q = 0; q < index.pairs; q++) {
      const double* w = wz[index.pair_z[q]];
      Part r = sum[0][index.pair_y[q]] * w[0];
#pragma GCC unroll 8
      for (int k = 1; k < 8; k++) r += sum[k][index.pair_y[q]] * w[k];
      out.rows[q].v[part] = r;
    }
  }
}

/// All derivatives up to Order at eight points; points[axis][lane].
template <int Order>
LAMELLA_INLINE void derivatives(const SplineView& s, const double (*points)[8], V8* out) {
  constexpr const auto& index = derivative_index<Order>;
  Contracted<Order> at[8];
#pragma GCC unroll 1
  for (int l = 0; l < 8; l++) {
    const double p[3] = {points[0][l], points[1][l], points[2][l]};
    contract<Order>(s, p, at[l]);
  }
#pragma GCC unroll 35
  for (int m = 0; m < index.count; m++) {
    V8 product[8];
#pragma GCC unroll 8
    for (int l = 0; l < 8; l++) product[l] = at[l].rows[index.pair[m]] * load(at[l].wx[index.x[m]]);
    out[m] = sums_of(product);
  }
}

} // namespace lamella::LAMELLA_ISA
