#pragma once

namespace lamella {

/// Energy density of local stretching, f(c) = mu/2 [(1 - c)^2 + (1 - 1/c)^2] (Eq. 85), and its
/// derivatives; c is lipid per area over its rest value.
struct StretchEnergy {
  double modulus = 0; ///< mu, energy / length^2

  struct Value {
    double f, d1, d2, d3;
    /// sigma_c = f - c f', the tension that stretching makes.
    double tension(double c) const { return f - c * d1; }
  };
  Value at(double c) const {
    const double i = 1 / c, mu = modulus;
    return {0.5 * mu * ((1 - c) * (1 - c) + (1 - i) * (1 - i)), mu * (c - 1 + (1 - i) * i * i),
            mu * (1 + (3 * i - 2) * i * i * i), mu * (6 - 12 * i) * i * i * i * i};
  }
  /// How fast gradients of c even out: d c/dt = rate k^2 for small deviations from 1.
  double diffusivity() const { return 2 * modulus; }
};

} // namespace lamella
