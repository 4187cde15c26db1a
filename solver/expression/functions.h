#pragma once
#include <cmath>
#include <cstddef>

namespace lamella {

/// The functions of one number that formulas are made of. All are smooth where they are defined.
enum class Function { reciprocal, sqrt, exp, log, sin, cos, tan, sinh, cosh, tanh, atan };

/// A function at a number: value, first and second derivative.
template <class T>
struct SecondOrder {
  T value, first, second;
};

/// Numbers that carry more than a value, such as SurfaceJet: made of a value `f`, on which a
/// function acts by its value and derivatives there, compose(h, h', h'', x).
template <class T>
concept Composable = requires(const T& x) {
  compose(x.f, x.f, x.f, x);
};

/// Several numbers side by side: Eigen arrays, and vectors of the compiler.
template <class T>
concept Lanewise = requires(T x) {
  x[0] = 1.;
};

/// The function's value alone. T: a number, or several.
template <class T>
T value_at(Function function, const T& x) {
  using std::sqrt, std::exp, std::log, std::sin, std::cos, std::tan, std::sinh, std::cosh,
      std::tanh, std::atan;
  switch (function) {
  case Function::reciprocal:
    return 1. / x;
  case Function::sqrt:
    return sqrt(x);
  case Function::exp:
    return exp(x);
  case Function::log:
    return log(x);
  case Function::sin:
    return sin(x);
  case Function::cos:
    return cos(x);
  case Function::tan:
    return tan(x);
  case Function::sinh:
    return sinh(x);
  case Function::cosh:
    return cosh(x);
  case Function::tanh:
    return tanh(x);
  case Function::atan:
    return atan(x);
  }
  return x;
}
template <Lanewise T>
T value_at(Function function, const T& x) {
  if (function == Function::reciprocal) return 1. / x;
  T values = x;
  for (std::size_t lane = 0; lane < sizeof(T) / sizeof(double); ++lane)
    values[lane] = value_at(function, double(x[lane]));
  return values;
}

/// The function with two derivatives. T as in value_at.
template <class T>
SecondOrder<T> second_order_at(Function function, const T& x) {
  const T h = value_at(function, x);
  T h1 = h, h2 = h; // which they are for exp, and h2 for sinh and cosh
  switch (function) {
  case Function::reciprocal:
    h1 = -h * h;
    h2 = -2. * h * h1;
    break;
  case Function::sqrt:
    h1 = 0.5 / h;
    h2 = -2. * h1 * h1 * h1;
    break;
  case Function::exp:
    break;
  case Function::log:
    h1 = 1. / x;
    h2 = -h1 * h1;
    break;
  case Function::sin:
    h1 = value_at(Function::cos, x);
    h2 = -h;
    break;
  case Function::cos:
    h1 = -value_at(Function::sin, x);
    h2 = -h;
    break;
  case Function::tan:
    h1 = 1. + h * h;
    h2 = 2. * h * h1;
    break;
  case Function::sinh:
    h1 = value_at(Function::cosh, x);
    break;
  case Function::cosh:
    h1 = value_at(Function::sinh, x);
    break;
  case Function::tanh:
    h1 = 1. - h * h;
    h2 = -2. * h * h1;
    break;
  case Function::atan:
    h1 = 1. / (1. + x * x);
    h2 = -2. * x * h1 * h1;
    break;
  }
  return {h, h1, h2};
}

/// A function of a number of any kind that formulas are evaluated with.
template <class T>
T apply(Function function, const T& x) {
  if constexpr (Composable<T>) {
    const auto [value, first, second] = second_order_at(function, x.f);
    return compose(value, first, second, x);
  } else {
    return value_at(function, x);
  }
}

} // namespace lamella
