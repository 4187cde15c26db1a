#pragma once
#include "energy/surface_jet.h"
#include "expression/functions.h"

namespace lamella {

/// The derivative of a function at x, from its value h there; for any kind of number that densities
/// are computed with.
template <class T>
T derivative_at(Function function, const T& x, const T& h) {
  switch (function) {
  case Function::reciprocal:
    return -1.0 * (h * h);
  case Function::sqrt:
    return 0.5 * apply(Function::reciprocal, h);
  case Function::exp:
    return h;
  case Function::log:
    return apply(Function::reciprocal, x);
  case Function::sin:
    return apply(Function::cos, x);
  case Function::cos:
    return -1.0 * apply(Function::sin, x);
  case Function::tan:
    return constant<T>(1) + h * h;
  case Function::sinh:
    return apply(Function::cosh, x);
  case Function::cosh:
    return apply(Function::sinh, x);
  case Function::tanh:
    return constant<T>(1) - h * h;
  case Function::atan:
    return apply(Function::reciprocal, constant<T>(1) + x * x);
  }
  return h;
}

/// A function in a density that is written in C++: apply(Function::sqrt, K) for any N.
template <class T>
Dual<T> apply(Function function, const Dual<T>& x) {
  const T h = apply(function, x.f);
  return {h, derivative_at(function, x.f, h) * x.d};
}

} // namespace lamella
