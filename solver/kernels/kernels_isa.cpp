// Compiled once for each instruction set, with LAMELLA_ISA as the namespace. No standard-library
// code may be instantiated here: the linker would keep one copy, perhaps one that this CPU cannot
// run.
#include "kernels/kernels.h"

#include "kernels/derivatives.h"
#include "kernels/taylor2.h"

namespace lamella::LAMELLA_ISA {
namespace {

/// Coordinates of eight points from `first` on, out[axis][lane]; past the end the last point is
/// repeated.
LAMELLA_INLINE void gather(const ConstPoints& p, std::size_t first, std::size_t n,
                           double (*out)[8]) {
  for (int l = 0; l < 8; l++) {
    const std::size_t i = first + l < n ? first + l : n - 1;
    out[0][l] = p.x[i];
    out[1][l] = p.y[i];
    out[2][l] = p.z[i];
  }
}

LAMELLA_INLINE void put(double* out, std::size_t first, std::size_t n, V8 v) {
  if (first + 8 <= n)
    store(out + first, v);
  else
    for (std::size_t l = 0; first + l < n; l++) out[first + l] = v[l];
}

LAMELLA_INLINE V8 dot(const V8* a, const V8* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Hessian of the spline and its cofactors, ordered xx yy zz xy xz yz.
struct Symmetric {
  V8 xx, yy, zz, xy, xz, yz;

  Symmetric cofactors() const {
    return {yy * zz - yz * yz, xx * zz - xz * xz, xx * yy - xy * xy,
            xz * yz - xy * zz, xy * yz - yy * xz, xy * xz - xx * yz};
  }
  void apply(const V8* v, V8* out) const {
    out[0] = xx * v[0] + xy * v[1] + xz * v[2];
    out[1] = xy * v[0] + yy * v[1] + yz * v[2];
    out[2] = xz * v[0] + yz * v[1] + zz * v[2];
  }
};

template <int Order>
LAMELLA_INLINE Symmetric hessian(const V8* d) {
  constexpr const auto& s = derivative_index<Order>.slot;
  return {d[s[2][0][0]], d[s[0][2][0]], d[s[0][0][2]], d[s[1][1][0]], d[s[1][0][1]], d[s[0][1][1]]};
}

// ------------------------------------------------------------------------------------------- nodal
// values

/// out[i] = fir applied along a row that repeats periodically.
LAMELLA_INLINE void fir_row(const double* in, int n, double* extended, double* out) {
  for (int i = 0; i < 3; i++) {
    extended[i] = in[n - 3 + i];
    extended[n + 3 + i] = in[i];
  }
  for (int i = 0; i < n; i++) extended[i + 3] = in[i];
  for (int i = 0; i < n; i++)
    out[i] = fir[0] * extended[i + 3] + fir[1] * (extended[i + 2] + extended[i + 4]) +
             fir[2] * (extended[i + 1] + extended[i + 5]) +
             fir[3] * (extended[i] + extended[i + 6]);
}

/// out = fir across seven rows, row[0] the middle one and row[2 m - 1], row[2 m] those at distance
/// m.
LAMELLA_INLINE void fir_across(const double* const* row, std::size_t n, double* out) {
  for (std::size_t i = 0; i < n; i++)
    out[i] = fir[0] * row[0][i] + fir[1] * (row[1][i] + row[2][i]) +
             fir[2] * (row[3][i] + row[4][i]) + fir[3] * (row[5][i] + row[6][i]);
}

/// The seven rows around row `i` of `count` rows of length n.
LAMELLA_INLINE void rows_around(const double* first, std::size_t n, int i, int count,
                                const double** row) {
  row[0] = first + i * n;
  for (int m = 1; m <= 3; m++) {
    row[2 * m - 1] = first + (i - m + count) % count * n;
    row[2 * m] = first + (i + m) % count * n;
  }
}

/// scratch: nx ny + 2 nx + 6 numbers.
void nodal_plane(const SplineView& s, int k, double* scratch, double* out) {
  const std::size_t nx = s.nodes[0], ny = s.nodes[1];
  const double* row[7];
  rows_around(s.coefficients, nx * ny, k, s.nodes[2], row);
  fir_across(row, nx * ny, scratch);
  double *line = scratch + nx * ny, *extended = line + nx;
  for (int j = 0; j < s.nodes[1]; j++) {
    rows_around(scratch, nx, j, s.nodes[1], row);
    fir_across(row, nx, line);
    fir_row(line, s.nodes[0], extended, out + j * nx);
  }
}

// ----------------------------------------------------------------------------------------- closest
// points

constexpr double longest_step = 0.7; // in spacings

/// Newton step of the nearest point, whose unknowns are e = x - p along the surface (to become 0)
/// and f: (I + lambda H_t) dp = e_t + dn (n - lambda H_tn), dn = -f / |g|, lambda = e.n / |g|, with
/// H_t the Hessian in the tangent plane. The determinant is (1 - d k1) (1 - d k2), whatever phi
/// does across the surface. Where it is small (near the focal points), the step dn alone.
LAMELLA_INLINE void newton_step(const V8* d, const V8* x, const V8* p, V8* step) {
  constexpr const auto& s = derivative_index<2>.slot;
  const V8 f = d[s[0][0][0]], g[3] = {d[s[1][0][0]], d[s[0][1][0]], d[s[0][0][1]]};
  const V8 inv_grad = 1.0 / square_root(dot(g, g) + 1e-300), dn = -f * inv_grad;
  const V8 n[3] = {g[0] * inv_grad, g[1] * inv_grad, g[2] * inv_grad};
  const V8 e[3] = {x[0] - p[0], x[1] - p[1], x[2] - p[2]};
  const V8 en = dot(e, n), lambda = en * inv_grad;
  const Symmetric H = hessian<2>(d);
  V8 Hn[3], t[3];
  H.apply(n, Hn);
  const V8 nHn = dot(n, Hn);
  for (int c = 0; c < 3; c++) t[c] = Hn[c] - 0.5 * nHn * n[c]; // H_t = H - n t - t n
  const Symmetric m = {
      1.0 + lambda * (H.xx - 2.0 * n[0] * t[0]),   1.0 + lambda * (H.yy - 2.0 * n[1] * t[1]),
      1.0 + lambda * (H.zz - 2.0 * n[2] * t[2]),   lambda * (H.xy - n[0] * t[1] - n[1] * t[0]),
      lambda * (H.xz - n[0] * t[2] - n[2] * t[0]), lambda * (H.yz - n[1] * t[2] - n[2] * t[1])};
  const Symmetric cof = m.cofactors();
  const V8 det = m.xx * cof.xx + m.xy * cof.xy + m.xz * cof.xz;
  V8 r[3], u[3];
  for (int c = 0; c < 3; c++) r[c] = e[c] - en * n[c] + dn * (n[c] - lambda * (Hn[c] - nHn * n[c]));
  cof.apply(r, u);
  const Mask8 regular = splat(0.05) < det;
  const V8 inv_det = 1.0 / select(regular, det, splat(1));
  for (int c = 0; c < 3; c++) step[c] = select(regular, u[c] * inv_det, dn * n[c]);
}

/// Last gradient step onto {f = 0}; lanes that would need more than half a spacing go back to
/// `start`.
LAMELLA_INLINE void verify_points(const SplineView& s, const double (*q)[8], const V8* start, V8* p,
                                  V8& length) {
  V8 d[derivative_index<1>.count];
  derivatives<1>(s, q, d);
  constexpr const auto& slot = derivative_index<1>.slot;
  const V8 g[3] = {d[slot[1][0][0]], d[slot[0][1][0]], d[slot[0][0][1]]};
  const V8 g2 = dot(g, g) + 1e-300, m = -d[slot[0][0][0]] / g2;
  const Mask8 good = m * m * g2 < splat(0.25 / (s.inv_spacing * s.inv_spacing));
  for (int c = 0; c < 3; c++) p[c] = select(good, p[c] + m * g[c], start[c]);
  length = select(good, length, splat(-1));
}

void closest_points(const SplineView& s, std::size_t n, ConstPoints x, Points points,
                    int iterations, bool verify, double* step_out) {
  const double h = 1 / s.inv_spacing;
  for (std::size_t first = 0; first < n; first += 8) {
    alignas(64) double q[3][8];
    V8 px[3], pp[3], start[3], length = splat(0);
    gather(x, first, n, q);
    for (int c = 0; c < 3; c++) px[c] = load(q[c]);
    gather({points.x, points.y, points.z}, first, n, q);
    for (int c = 0; c < 3; c++) start[c] = pp[c] = load(q[c]);
    for (int it = 0; it < iterations; it++) {
      V8 d[derivative_index<2>.count], step[3];
      derivatives<2>(s, q, d);
      newton_step(d, px, pp, step);
      length = square_root(dot(step, step));
      const V8 longest = splat(longest_step * h);
      const V8 clip = select(longest < length, longest / length, splat(1));
      for (int c = 0; c < 3; c++) {
        pp[c] += clip * step[c];
        store(q[c], pp[c]);
      }
      if (!any(splat(1e-7 * h) < length)) break;
    }
    if (verify) verify_points(s, q, start, pp, length);
    put(points.x, first, n, pp[0]);
    put(points.y, first, n, pp[1]);
    put(points.z, first, n, pp[2]);
    put(step_out, first, n, length);
  }
}

// -----------------------------------------------------------------------------------------------
// geometry

struct Curvatures {
  V8 phi, normal[3], grad, inv_s, KM, K;
};

/// K_M = -div N and K = N.cof(H).N / |g|^2 of the level surface through each point.
template <int Order>
LAMELLA_INLINE Curvatures curvatures_from(const V8* d) {
  constexpr const auto& s = derivative_index<Order>.slot;
  Curvatures c;
  c.phi = d[s[0][0][0]];
  const V8 g[3] = {d[s[1][0][0]], d[s[0][1][0]], d[s[0][0][1]]};
  const Symmetric H = hessian<Order>(d), cof = H.cofactors();
  const V8 g2 = dot(g, g);
  c.grad = square_root(g2);
  c.inv_s = 1.0 / g2;
  for (int m = 0; m < 3; m++) c.normal[m] = g[m] / c.grad;
  V8 hn[3], cn[3];
  H.apply(c.normal, hn);
  cof.apply(c.normal, cn);
  c.KM = (dot(c.normal, hn) - (H.xx + H.yy + H.zz)) / c.grad;
  c.K = dot(c.normal, cn) * c.inv_s;
  return c;
}

LAMELLA_INLINE void put_curvatures(const Curvatures& c, std::size_t first, std::size_t n,
                                   const SurfaceArrays& out) {
  put(out.phi, first, n, c.phi);
  put(out.nx, first, n, c.normal[0]);
  put(out.ny, first, n, c.normal[1]);
  put(out.nz, first, n, c.normal[2]);
  put(out.grad, first, n, c.grad);
  put(out.KM, first, n, c.KM);
  put(out.K, first, n, c.K);
}

void curvatures(const SplineView& s, std::size_t n, ConstPoints p, const SurfaceArrays& out) {
  for (std::size_t first = 0; first < n; first += 8) {
    alignas(64) double q[3][8];
    V8 d[derivative_index<2>.count];
    gather(p, first, n, q);
    derivatives<2>(s, q, d);
    put_curvatures(curvatures_from<2>(d), first, n, out);
  }
}

/// A derivative of phi with its own first and second derivatives, from those up to order 4.
LAMELLA_INLINE Taylor2 derivative_of_phi(const V8* d, int i, int j, int k) {
  constexpr const auto& s = derivative_index<4>.slot;
  return {d[s[i][j][k]],         d[s[i + 1][j][k]],    d[s[i][j + 1][k]], d[s[i][j][k + 1]],
          d[s[i + 2][j][k]],     d[s[i][j + 2][k]],    d[s[i][j][k + 2]], d[s[i + 1][j + 1][k]],
          d[s[i + 1][j][k + 1]], d[s[i][j + 1][k + 1]]};
}

/// The first and second derivatives of phi, with their own.
struct GradientAndHessian {
  Taylor2 x, y, z, xx, yy, zz, xy, xz, yz, x2, y2, z2;
};
LAMELLA_INLINE GradientAndHessian gradient_and_hessian(const V8* d) {
  const Taylor2 x = derivative_of_phi(d, 1, 0, 0), y = derivative_of_phi(d, 0, 1, 0),
                z = derivative_of_phi(d, 0, 0, 1);
  return {x,
          y,
          z,
          derivative_of_phi(d, 2, 0, 0),
          derivative_of_phi(d, 0, 2, 0),
          derivative_of_phi(d, 0, 0, 2),
          derivative_of_phi(d, 1, 1, 0),
          derivative_of_phi(d, 1, 0, 1),
          derivative_of_phi(d, 0, 1, 1),
          x * x,
          y * y,
          z * z};
}

/// K_M = -div N of all level surfaces around, in space.
LAMELLA_INLINE Taylor2 KM_around(const GradientAndHessian& g, const Curvatures& c) {
  const Taylor2 cross = g.x * (g.y * g.xy + g.z * g.xz) + g.y * g.z * g.yz;
  const Taylor2 numerator =
      cross + cross - g.x2 * (g.yy + g.zz) - g.y2 * (g.xx + g.zz) - g.z2 * (g.xx + g.yy);
  return numerator * inverse_cubed_root(g.x2 + g.y2 + g.z2, c.inv_s, 1.0 / c.grad);
}

/// K = g.cof(H).g / |g|^4 of all level surfaces around.
LAMELLA_INLINE Taylor2 K_around(const GradientAndHessian& g, const Curvatures& c) {
  const Taylor2 straight = g.x2 * (g.yy * g.zz - g.yz * g.yz) + g.y2 * (g.xx * g.zz - g.xz * g.xz) +
                           g.z2 * (g.xx * g.yy - g.xy * g.xy);
  const Taylor2 crossed = g.x * g.y * (g.xz * g.yz - g.xy * g.zz) +
                          g.x * g.z * (g.xy * g.yz - g.yy * g.xz) +
                          g.y * g.z * (g.xy * g.xz - g.xx * g.yz);
  return (straight + crossed + crossed) * inverse_square(g.x2 + g.y2 + g.z2, c.inv_s);
}

/// f P H P, P the projection along the surface.
LAMELLA_INLINE Symmetric projected(V8 f, const Symmetric& H, const Curvatures& c) {
  const V8* N = c.normal;
  V8 HN[3], t[3];
  H.apply(N, HN);
  const V8 NHN = dot(N, HN);
  for (int m = 0; m < 3; m++) t[m] = HN[m] - 0.5 * NHN * N[m]; // P H P = H - N t - t N
  return {f * (H.xx - 2.0 * N[0] * t[0]),         f * (H.yy - 2.0 * N[1] * t[1]),
          f * (H.zz - 2.0 * N[2] * t[2]),         f * (H.xy - N[0] * t[1] - N[1] * t[0]),
          f * (H.xz - N[0] * t[2] - N[2] * t[0]), f * (H.yz - N[1] * t[2] - N[2] * t[1])};
}

/// B = -P H P / |g|.
LAMELLA_INLINE Symmetric curvature_tensor(const V8* d, const Curvatures& c) {
  return projected(-1.0 / c.grad, hessian<4>(d), c);
}

/// grad_s grad_s F = P Hess(F) P + B N.grad F.
LAMELLA_INLINE Symmetric surface_hessian(const Symmetric& B, const Taylor2& F, const Curvatures& c,
                                         V8 along) {
  const Symmetric H = projected(splat(1), {F.xx, F.yy, F.zz, F.xy, F.xz, F.yz}, c);
  return {H.xx + along * B.xx, H.yy + along * B.yy, H.zz + along * B.zz,
          H.xy + along * B.xy, H.xz + along * B.xz, H.yz + along * B.yz};
}

/// N.grad F.
LAMELLA_INLINE V8 along_normal(const Taylor2& F, const Curvatures& c) {
  const V8* N = c.normal;
  return N[0] * F.x + N[1] * F.y + N[2] * F.z;
}

/// Eq. 58 (corrected, see docs/theory.md): Lap_s F = Lap F + K_M N.grad F - N.Hess(F).N. No
/// property of a distance function is used.
LAMELLA_INLINE V8 surface_laplacian(const Taylor2& F, const Curvatures& c, V8 along) {
  const V8* N = c.normal;
  const V8 NHN = N[0] * N[0] * F.xx + N[1] * N[1] * F.yy + N[2] * N[2] * F.zz +
                 2.0 * (N[0] * N[1] * F.xy + N[0] * N[2] * F.xz + N[1] * N[2] * F.yz);
  return F.xx + F.yy + F.zz - NHN + c.KM * along;
}

/// B : grad_s grad_s F = B : Hess(F) + (B : B) N.grad F.
LAMELLA_INLINE V8 times_hessian(const Symmetric& B, const Taylor2& F, const Curvatures& c,
                                V8 along) {
  return B.xx * F.xx + B.yy * F.yy + B.zz * F.zz + 2.0 * (B.xy * F.xy + B.xz * F.xz + B.yz * F.yz) +
         (c.KM * c.KM - 2.0 * c.K) * along;
}

LAMELLA_INLINE void put_surface_gradient(const Taylor2& F, const Curvatures& c, V8 along,
                                         std::size_t first, std::size_t n, double* const* out) {
  const V8 gradient[3] = {F.x, F.y, F.z};
  for (int m = 0; m < 3; m++) put(out[m], first, n, gradient[m] - along * c.normal[m]);
}

LAMELLA_INLINE void put_tensor(const Symmetric& B, std::size_t first, std::size_t n,
                               double* const* out) {
  const V8 all[6] = {B.xx, B.yy, B.zz, B.xy, B.xz, B.yz};
  for (int m = 0; m < 6; m++) put(out[m], first, n, all[m]);
}

void jets(const SplineView& s, std::size_t n, ConstPoints p, const SurfaceArrays& out) {
  for (std::size_t first = 0; first < n; first += 8) {
    alignas(64) double q[3][8];
    V8 d[derivative_index<4>.count];
    gather(p, first, n, q);
    derivatives<4>(s, q, d);
    const Curvatures c = curvatures_from<4>(d);
    put_curvatures(c, first, n, out);
    const Taylor2 KM = KM_around(gradient_and_hessian(d), c);
    const V8 along = along_normal(KM, c);
    put(out.lap_KM, first, n, surface_laplacian(KM, c, along));
    put(out.slope2, first, n, KM.x * KM.x + KM.y * KM.y + KM.z * KM.z - along * along);
    if (!out.grad_KM[0]) continue;
    put_surface_gradient(KM, c, along, first, n, out.grad_KM);
    put_tensor(curvature_tensor(d, c), first, n, out.B);
  }
}

void full_jets(const SplineView& s, std::size_t n, ConstPoints p, const SurfaceArrays& out) {
  for (std::size_t first = 0; first < n; first += 8) {
    alignas(64) double q[3][8];
    V8 d[derivative_index<4>.count];
    gather(p, first, n, q);
    derivatives<4>(s, q, d);
    const Curvatures c = curvatures_from<4>(d);
    put_curvatures(c, first, n, out);
    const GradientAndHessian g = gradient_and_hessian(d);
    const Symmetric B = curvature_tensor(d, c);
    put_tensor(B, first, n, out.B);
    const Taylor2 KM = KM_around(g, c);
    V8 along = along_normal(KM, c);
    put(out.lap_KM, first, n, surface_laplacian(KM, c, along));
    put(out.slope2, first, n, KM.x * KM.x + KM.y * KM.y + KM.z * KM.z - along * along);
    put(out.B_hess_KM, first, n, times_hessian(B, KM, c, along));
    put_surface_gradient(KM, c, along, first, n, out.grad_KM);
    if (out.hess_KM[0]) put_tensor(surface_hessian(B, KM, c, along), first, n, out.hess_KM);
    const Taylor2 K = K_around(g, c);
    along = along_normal(K, c);
    put(out.lap_K, first, n, surface_laplacian(K, c, along));
    put(out.B_hess_K, first, n, times_hessian(B, K, c, along));
    put_surface_gradient(K, c, along, first, n, out.grad_K);
  }
}

void values(const SplineView& s, std::size_t n, ConstPoints p, double* out) {
  for (std::size_t first = 0; first < n; first += 8) {
    alignas(64) double q[3][8];
    V8 value[1];
    gather(p, first, n, q);
    derivatives<0>(s, q, value);
    put(out, first, n, value[0]);
  }
}

void taylor(const SplineView& s, std::size_t n, ConstPoints p, double* out) {
  constexpr const auto& slot = derivative_index<2>.slot;
  for (std::size_t first = 0; first < n; first += 8) {
    alignas(64) double q[3][8];
    V8 d[derivative_index<2>.count];
    gather(p, first, n, q);
    derivatives<2>(s, q, d);
    const Symmetric H = hessian<2>(d);
    const V8 all[10] = {d[slot[0][0][0]],
                        d[slot[1][0][0]],
                        d[slot[0][1][0]],
                        d[slot[0][0][1]],
                        H.xx,
                        H.yy,
                        H.zz,
                        H.xy,
                        H.xz,
                        H.yz};
    for (int m = 0; m < 10; m++) put(out + m * n, first, n, all[m]);
  }
}

/// xxx, xxy, xxz, xyy, xyz, xzz, yyy, yyz, yzz, zzz.
void third(const SplineView& s, std::size_t n, ConstPoints p, double* out) {
  constexpr const auto& slot = derivative_index<3>.slot;
  for (std::size_t first = 0; first < n; first += 8) {
    alignas(64) double q[3][8];
    V8 d[derivative_index<3>.count];
    gather(p, first, n, q);
    derivatives<3>(s, q, d);
    int m = 0;
    for (int x = 3; x >= 0; x--)
      for (int y = 3 - x; y >= 0; y--) put(out + m++ * n, first, n, d[slot[x][y][3 - x - y]]);
  }
}

// ---------------------------------------------------------------------------------- cubic
// quasi-interpolant

typedef double Four __attribute__((vector_size(32), aligned(8), may_alias));

void cubic(const SplineView& s, std::size_t n, ConstPoints points, double* out) {
  for (std::size_t i = 0; i < n; i++) {
    const double p[3] = {points.x[i], points.y[i], points.z[i]};
    const Cell cell = cell_of(s, p);
    alignas(64) double buffer[64];
    const Stencil st = stencil_of<4>(s, cell, buffer);
    double w[3][4];
    for (int d = 0; d < 3; d++) {
      const double t = cell.t[d], u = 1 - t;
      w[d][0] = u * u * u / 6;
      w[d][1] = (4 - 6 * t * t + 3 * t * t * t) / 6;
      w[d][2] = (4 - 6 * u * u + 3 * u * u * u) / 6;
      w[d][3] = t * t * t / 6;
    }
    Four sum = {};
    for (int k = 0; k < 4; k++)
      for (int j = 0; j < 4; j++)
        sum += *reinterpret_cast<const Four*>(st.data + k * st.stride_z + j * st.stride_y) *
               (w[2][k] * w[1][j]);
    out[i] = sum[0] * w[0][0] + sum[1] * w[0][1] + sum[2] * w[0][2] + sum[3] * w[0][3];
  }
}

// -------------------------------------------------------------------------------------------
// spectral step

/// `sixth`: whether there is a part of sixth order.
template <bool sixth>
LAMELLA_INLINE double implicit_symbol(const SpectralRow& row, double k2) {
  double stiffness = row.stiffness;
  if constexpr (sixth) stiffness += row.gradient * k2 / (1 + row.levelling * k2 * k2);
  return row.dt * k2 * (stiffness * k2 + row.tension);
}

template <bool sixth>
LAMELLA_INLINE void advance_row(const SpectralRow& row, double* __restrict rate,
                                double* __restrict rate_old, double* __restrict increment_old,
                                const double* __restrict correction, double correction_factor) {
  const double w = row.ratio, gain = (1 + 2 * w) / (1 + w) - 1, memory = w * w / (1 + w),
               inv_z0 = 1 / row.blend, inv_z1 = 1 / row.fade;
  for (int e = 0; e < 2 * row.modes; e++) {
    const double k2 = row.kx2[e] + row.k2, z = implicit_symbol<sixth>(row, k2);
    const double theta = row.share / (1 + z * inv_z1) + (1 - row.share) / (1 + z * inv_z0);
    const double r = rate[e] * row.scale * row.inv_symbol[e];
    const double last = increment_old[e] + correction_factor * correction[e];
    const double d =
        (row.dt * (r + theta * w * (r - rate_old[e])) + theta * (memory + w * z) * last) /
        (1 + theta * gain + z);
    rate_old[e] = r;
    increment_old[e] = d;
    rate[e] = d;
  }
}

void spectral_row(const SpectralRow& row, double* rate, double* rate_old, double* increment_old,
                  const double* correction, double correction_factor) {
  if (row.gradient > 0)
    advance_row<true>(row, rate, rate_old, increment_old, correction, correction_factor);
  else
    advance_row<false>(row, rate, rate_old, increment_old, correction, correction_factor);
}

template <bool sixth>
LAMELLA_INLINE void advance_row_by_euler(const SpectralRow& row, double* __restrict rate) {
  for (int e = 0; e < 2 * row.modes; e++)
    rate[e] *= row.dt * row.scale * row.inv_symbol[e] /
               (1 + implicit_symbol<sixth>(row, row.kx2[e] + row.k2));
}

void euler_row(const SpectralRow& row, double* rate) {
  if (row.gradient > 0)
    advance_row_by_euler<true>(row, rate);
  else
    advance_row_by_euler<false>(row, rate);
}

} // namespace

#define LAMELLA_STRING_OF(x) #x
#define LAMELLA_STRING(x) LAMELLA_STRING_OF(x)

extern const Kernels table;
const Kernels table = {LAMELLA_STRING(LAMELLA_ISA),
                       nodal_plane,
                       closest_points,
                       curvatures,
                       jets,
                       full_jets,
                       values,
                       taylor,
                       third,
                       cubic,
                       spectral_row,
                       euler_row};

} // namespace lamella::LAMELLA_ISA
