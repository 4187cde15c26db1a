#pragma once

// Eight doubles at once (eight points, or eight spline taps), held in as many registers as this
// instruction set needs. Included only by kernels_isa.cpp.
namespace lamella::LAMELLA_ISA {

#define LAMELLA_INLINE static inline __attribute__((always_inline))
#define LAMELLA_MEMBER inline __attribute__((always_inline))

#if defined(__AVX512F__)
constexpr int width = 8;
#elif defined(__AVX2__)
constexpr int width = 4;
#else
constexpr int width = 2;
#endif
constexpr int parts = 8 / width;

typedef double Part __attribute__((vector_size(8 * width)));
typedef double PartAnywhere __attribute__((vector_size(8 * width), aligned(8), may_alias));
typedef long long PartMask __attribute__((vector_size(8 * width)));

LAMELLA_INLINE Part load_part(const double* p) { return *reinterpret_cast<const PartAnywhere*>(p); }
LAMELLA_INLINE Part splat_part(double a) { return a - Part{}; }

struct Mask8 {
  PartMask m[parts];
};

struct V8 {
  Part v[parts];

  LAMELLA_MEMBER double operator[](int lane) const { return v[lane / width][lane % width]; }
};

#define LAMELLA_EACH_PART _Pragma("GCC unroll 4") for (int i = 0; i < parts; i++)
#define LAMELLA_BINARY(op)                                                                         \
  LAMELLA_INLINE V8 operator op(V8 a, V8 b) {                                                      \
    LAMELLA_EACH_PART a.v[i] = a.v[i] op b.v[i];                                                   \
    return a;                                                                                      \
  }                                                                                                \
  LAMELLA_INLINE V8 operator op(V8 a, double b) {                                                  \
    LAMELLA_EACH_PART a.v[i] = a.v[i] op b;                                                        \
    return a;                                                                                      \
  }                                                                                                \
  LAMELLA_INLINE V8 operator op(double a, V8 b) {                                                  \
    LAMELLA_EACH_PART b.v[i] = a op b.v[i];                                                        \
    return b;                                                                                      \
  }
LAMELLA_BINARY(+)
LAMELLA_BINARY(-)
LAMELLA_BINARY(*)
LAMELLA_BINARY(/)
#undef LAMELLA_BINARY

LAMELLA_INLINE V8 operator-(V8 a) {
  LAMELLA_EACH_PART a.v[i] = -a.v[i];
  return a;
}
LAMELLA_INLINE void operator+=(V8& a, V8 b) { a = a + b; }

LAMELLA_INLINE V8 splat(double a) {
  V8 r;
  LAMELLA_EACH_PART r.v[i] = splat_part(a);
  return r;
}
LAMELLA_INLINE V8 load(const double* p) {
  V8 r;
  LAMELLA_EACH_PART r.v[i] = load_part(p + i * width);
  return r;
}
LAMELLA_INLINE void store(double* p, V8 a) {
  LAMELLA_EACH_PART* reinterpret_cast<PartAnywhere*>(p + i * width) = a.v[i];
}

LAMELLA_INLINE Mask8 operator<(V8 a, V8 b) {
  Mask8 r;
  LAMELLA_EACH_PART r.m[i] = a.v[i] < b.v[i];
  return r;
}
LAMELLA_INLINE Mask8 operator&(Mask8 a, Mask8 b) {
  LAMELLA_EACH_PART a.m[i] &= b.m[i];
  return a;
}
LAMELLA_INLINE V8 select(Mask8 mask, V8 yes, V8 no) {
  LAMELLA_EACH_PART yes.v[i] = mask.m[i] ? yes.v[i] : no.v[i];
  return yes;
}
LAMELLA_INLINE V8 square_root(V8 a) {
  LAMELLA_EACH_PART for (int l = 0; l < width; l++) a.v[i][l] = __builtin_sqrt(a.v[i][l]);
  return a;
}
LAMELLA_INLINE bool any(Mask8 mask) {
  bool r = false;
  for (int i = 0; i < parts; i++)
    for (int l = 0; l < width; l++) r |= mask.m[i][l] != 0;
  return r;
}

/// Lane l of the result is the sum of the lanes of a[l].
LAMELLA_INLINE V8 sums_of(const V8* a) {
  V8 r;
#if defined(__AVX512F__)
  Part b[4], c[2];
  for (int i = 0; i < 4; i++)
    b[i] = __builtin_shufflevector(a[2 * i].v[0], a[2 * i + 1].v[0], 0, 8, 2, 10, 4, 12, 6, 14) +
           __builtin_shufflevector(a[2 * i].v[0], a[2 * i + 1].v[0], 1, 9, 3, 11, 5, 13, 7, 15);
  for (int i = 0; i < 2; i++)
    c[i] = __builtin_shufflevector(b[2 * i], b[2 * i + 1], 0, 1, 8, 9, 4, 5, 12, 13) +
           __builtin_shufflevector(b[2 * i], b[2 * i + 1], 2, 3, 10, 11, 6, 7, 14, 15);
  r.v[0] = __builtin_shufflevector(c[0], c[1], 0, 1, 2, 3, 8, 9, 10, 11) +
           __builtin_shufflevector(c[0], c[1], 4, 5, 6, 7, 12, 13, 14, 15);
#elif defined(__AVX2__)
  for (int i = 0; i < 2; i++) {
    Part s[4], b[2];
    for (int l = 0; l < 4; l++) s[l] = a[4 * i + l].v[0] + a[4 * i + l].v[1];
    for (int l = 0; l < 2; l++)
      b[l] = __builtin_shufflevector(s[2 * l], s[2 * l + 1], 0, 4, 2, 6) +
             __builtin_shufflevector(s[2 * l], s[2 * l + 1], 1, 5, 3, 7);
    r.v[i] = __builtin_shufflevector(b[0], b[1], 0, 1, 4, 5) +
             __builtin_shufflevector(b[0], b[1], 2, 3, 6, 7);
  }
#else
  for (int i = 0; i < 4; i++) {
    Part s[2];
    for (int l = 0; l < 2; l++) {
      const V8& q = a[2 * i + l];
      s[l] = (q.v[0] + q.v[1]) + (q.v[2] + q.v[3]);
    }
    r.v[i] = __builtin_shufflevector(s[0], s[1], 0, 2) + __builtin_shufflevector(s[0], s[1], 1, 3);
  }
#endif
  return r;
}

} // namespace lamella::LAMELLA_ISA
