#pragma once
#include "kernels/vec8.h"

namespace lamella::LAMELLA_ISA {

/// Degree-2 Taylor arithmetic in three variables: value, gradient and Hessian, at eight points.
struct Taylor2 {
  V8 f, x, y, z, xx, yy, zz, xy, xz, yz;
};

LAMELLA_INLINE Taylor2 operator+(const Taylor2& a, const Taylor2& b) {
  return {a.f + b.f,   a.x + b.x,   a.y + b.y,   a.z + b.z,   a.xx + b.xx,
          a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.xz + b.xz, a.yz + b.yz};
}

LAMELLA_INLINE Taylor2 operator-(const Taylor2& a, const Taylor2& b) {
  return {a.f - b.f,   a.x - b.x,   a.y - b.y,   a.z - b.z,   a.xx - b.xx,
          a.yy - b.yy, a.zz - b.zz, a.xy - b.xy, a.xz - b.xz, a.yz - b.yz};
}

LAMELLA_INLINE Taylor2 operator*(const Taylor2& a, const Taylor2& b) {
  return {a.f * b.f,
          a.x * b.f + a.f * b.x,
          a.y * b.f + a.f * b.y,
          a.z * b.f + a.f * b.z,
          a.xx * b.f + 2.0 * a.x * b.x + a.f * b.xx,
          a.yy * b.f + 2.0 * a.y * b.y + a.f * b.yy,
          a.zz * b.f + 2.0 * a.z * b.z + a.f * b.zz,
          a.xy * b.f + a.x * b.y + a.y * b.x + a.f * b.xy,
          a.xz * b.f + a.x * b.z + a.z * b.x + a.f * b.xz,
          a.yz * b.f + a.y * b.z + a.z * b.y + a.f * b.yz};
}

/// h(s), from h and its first two derivatives at s.f.
LAMELLA_INLINE Taylor2 composed(V8 h, V8 h1, V8 h2, const Taylor2& s) {
  return {h,
          h1 * s.x,
          h1 * s.y,
          h1 * s.z,
          h1 * s.xx + h2 * s.x * s.x,
          h1 * s.yy + h2 * s.y * s.y,
          h1 * s.zz + h2 * s.z * s.z,
          h1 * s.xy + h2 * s.x * s.y,
          h1 * s.xz + h2 * s.x * s.z,
          h1 * s.yz + h2 * s.y * s.z};
}

/// s^(-3/2).
LAMELLA_INLINE Taylor2 inverse_cubed_root(const Taylor2& s, V8 inv_s, V8 inv_root) {
  const V8 w0 = inv_s * inv_root, w1 = -1.5 * w0 * inv_s, w2 = 3.75 * w0 * inv_s * inv_s;
  return composed(w0, w1, w2, s);
}

/// s^(-2).
LAMELLA_INLINE Taylor2 inverse_square(const Taylor2& s, V8 inv_s) {
  const V8 w0 = inv_s * inv_s, w1 = -2.0 * w0 * inv_s, w2 = -3.0 * w1 * inv_s;
  return composed(w0, w1, w2, s);
}

} // namespace lamella::LAMELLA_ISA
