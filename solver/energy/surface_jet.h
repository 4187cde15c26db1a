#pragma once
#include <array>
#include <concepts>
#include <type_traits>

/// Numbers that densities of the energy are computed with. A density is written once; what it is
/// computed with decides whether values, derivatives along the membrane or variations come out.
#if defined(LAMELLA_IS_PORTABLE) && defined(__AVX__)
#error "Lamella is built for any CPU: without -march and -mavx, which change how vectors are passed"
#endif

namespace lamella {

/// Eight samples side by side, in as many registers as it takes.
typedef double Lanes __attribute__((vector_size(64)));
inline Lanes lanes_of(double value) { return value - Lanes{}; }

/// A scalar on the membrane with all that a variation of the energy needs of it. Closed under +, -,
/// * and smooth functions: what is known of K_M, K and fields is known of every function of them.
template <class T>
struct SurfaceJet {
  T f;                     ///< the value
  std::array<T, 3> grad;   ///< grad_s f, along the membrane
  std::array<T, 3> B_grad; ///< B grad_s f, B the curvature tensor (trace K_M)
  T lap;                   ///< Lap_s f
  T B_hess;                ///< B : grad_s grad_s f
};

template <class T>
T dot(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class T>
SurfaceJet<T> operator+(SurfaceJet<T> a, const SurfaceJet<T>& b) {
  a.f += b.f;
  for (int d = 0; d < 3; d++) {
    a.grad[d] += b.grad[d];
    a.B_grad[d] += b.B_grad[d];
  }
  a.lap += b.lap;
  a.B_hess += b.B_hess;
  return a;
}

template <class T>
SurfaceJet<T> operator*(double s, SurfaceJet<T> a) {
  a.f *= s;
  for (int d = 0; d < 3; d++) {
    a.grad[d] *= s;
    a.B_grad[d] *= s;
  }
  a.lap *= s;
  a.B_hess *= s;
  return a;
}

template <class T>
SurfaceJet<T> operator-(const SurfaceJet<T>& a, const SurfaceJet<T>& b) {
  return a + -1.0 * b;
}

template <class T>
SurfaceJet<T> operator+(SurfaceJet<T> a, double s) {
  a.f += s;
  return a;
}

template <class T>
SurfaceJet<T> operator*(const SurfaceJet<T>& a, const SurfaceJet<T>& b) {
  SurfaceJet<T> c;
  c.f = a.f * b.f;
  for (int d = 0; d < 3; d++) {
    c.grad[d] = a.f * b.grad[d] + b.f * a.grad[d];
    c.B_grad[d] = a.f * b.B_grad[d] + b.f * a.B_grad[d];
  }
  c.lap = a.f * b.lap + b.f * a.lap + 2.0 * dot(a.grad, b.grad);
  c.B_hess = a.f * b.B_hess + b.f * a.B_hess + 2.0 * dot(a.grad, b.B_grad);
  return c;
}

/// h(a), from h and its first two derivatives at a.f.
template <class T>
SurfaceJet<T> compose(const T& h, const T& h1, const T& h2, const SurfaceJet<T>& a) {
  SurfaceJet<T> c;
  c.f = h;
  for (int d = 0; d < 3; d++) {
    c.grad[d] = h1 * a.grad[d];
    c.B_grad[d] = h1 * a.B_grad[d];
  }
  c.lap = h1 * a.lap + h2 * dot(a.grad, a.grad);
  c.B_hess = h1 * a.B_hess + h2 * dot(a.grad, a.B_grad);
  return c;
}

/// The value and Lap_s of a scalar that is affine in K_M with constant coefficients. (The product
/// of two that both vary has no right Lap_s.)
struct AffineJet {
  Lanes f, lap;
};
inline AffineJet operator+(const AffineJet& a, const AffineJet& b) {
  return {a.f + b.f, a.lap + b.lap};
}
inline AffineJet operator-(const AffineJet& a, const AffineJet& b) {
  return {a.f - b.f, a.lap - b.lap};
}
inline AffineJet operator*(double s, const AffineJet& a) { return {s * a.f, s * a.lap}; }
inline AffineJet operator+(const AffineJet& a, double s) { return {a.f + s, a.lap}; }
inline AffineJet operator*(const AffineJet& a, const AffineJet& b) {
  return {a.f * b.f, a.f * b.lap + b.f * a.lap};
}
inline AffineJet compose(const Lanes& h, const Lanes& h1, const Lanes&, const AffineJet& a) {
  return {h, h1 * a.lap};
}

/// A function of one variable with its first two derivatives.
struct Univariate {
  double f = 0, d1 = 0, d2 = 0;
};
inline Univariate operator+(const Univariate& a, const Univariate& b) {
  return {a.f + b.f, a.d1 + b.d1, a.d2 + b.d2};
}
inline Univariate operator-(const Univariate& a, const Univariate& b) {
  return {a.f - b.f, a.d1 - b.d1, a.d2 - b.d2};
}
inline Univariate operator*(double s, const Univariate& a) { return {s * a.f, s * a.d1, s * a.d2}; }
inline Univariate operator+(const Univariate& a, double s) { return {a.f + s, a.d1, a.d2}; }
inline Univariate operator*(const Univariate& a, const Univariate& b) {
  return {a.f * b.f, a.f * b.d1 + b.f * a.d1, a.f * b.d2 + b.f * a.d2 + 2 * a.d1 * b.d1};
}
inline Univariate compose(double h, double h1, double h2, const Univariate& a) {
  return {h, h1 * a.d1, h1 * a.d2 + h2 * a.d1 * a.d1};
}

/// A number and its derivative by something (by K_M, say).
template <class T>
struct Dual {
  T f, d;
};
template <class T>
Dual<T> operator+(const Dual<T>& a, const Dual<T>& b) {
  return {a.f + b.f, a.d + b.d};
}
template <class T>
Dual<T> operator-(const Dual<T>& a, const Dual<T>& b) {
  return {a.f - b.f, a.d - b.d};
}
template <class T>
Dual<T> operator*(const Dual<T>& a, const Dual<T>& b) {
  return {a.f * b.f, a.f * b.d + a.d * b.f};
}
template <class T>
Dual<T> operator*(double s, const Dual<T>& a) {
  return {s * a.f, s * a.d};
}
// With what does not depend on it.
template <class T, class C>
requires std::convertible_to<const C&, const T&> Dual<T>
operator*(const C& c, const Dual<T>& a) { return {c * a.f, c * a.d}; }
template <class T, class C>
requires std::convertible_to<const C&, const T&> Dual<T>
operator-(const Dual<T>& a, const C& c) { return {a.f - c, a.d}; }
template <class T, class C>
requires std::convertible_to<const C&, const T&> Dual<T>
operator+(const Dual<T>& a, const C& c) { return {a.f + c, a.d}; }
template <class T>
Dual<Dual<T>> operator+(const Dual<Dual<T>>& a, const T& c) {
  return {a.f + c, a.d};
}
template <class T>
Dual<Dual<T>> operator*(const T& c, const Dual<Dual<T>>& a) {
  return {c * a.f, c * a.d};
}
template <class T>
Dual<Dual<T>> operator-(const Dual<Dual<T>>& a, const T& c) {
  return {a.f - c, a.d};
}

/// Numbers that do not vary, of each kind.
template <class N>
struct Constant;
template <>
struct Constant<Lanes> {
  static Lanes of(double value) { return lanes_of(value); }
};
template <>
struct Constant<Univariate> {
  static Univariate of(double value) { return {value, 0, 0}; }
};
template <>
struct Constant<AffineJet> {
  static AffineJet of(double value) { return {lanes_of(value), Lanes{}}; }
};
template <class T>
struct Constant<SurfaceJet<T>> {
  static SurfaceJet<T> of(double value) {
    const T zero = Constant<T>::of(0);
    return {Constant<T>::of(value), {zero, zero, zero}, {zero, zero, zero}, zero, zero};
  }
};
template <class T>
struct Constant<Dual<T>> {
  static Dual<T> of(double value) { return {Constant<T>::of(value), Constant<T>::of(0)}; }
};
template <>
struct Constant<double> {
  static double of(double value) { return value; }
};
template <class N>
N constant(double value) {
  return Constant<N>::of(value);
}

/// The number in its simplest form.
inline const Lanes& value_of(const Lanes& a) { return a; }
inline double value_of(const Univariate& a) { return a.f; }
inline const Lanes& value_of(const AffineJet& a) { return a.f; }
template <class T>
const T& value_of(const SurfaceJet<T>& a) {
  return a.f;
}

inline Lanes reciprocal(const Lanes& a) { return 1.0 / a; }
inline double reciprocal(double a) { return 1 / a; }
/// 1/a, a not near 0.
template <class N>
N reciprocal(const N& a) {
  const auto h = reciprocal(a.f);
  using T = std::decay_t<decltype(h)>;
  const T h2 = h * h;
  return compose(T(h), T(-h2), T(2.0 * h2 * h), a);
}

} // namespace lamella
