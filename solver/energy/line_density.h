#pragma once
#include "geometry/curve_geometry.h"
#include "scene/scene.h"

#include <memory>

namespace lamella {

/// Energy per length of the phase boundary, l(kg, kn, tau_g, B_perp), oint l dl (Eq. 6).
class LineDensity {
public:
  /// l and its partial derivatives.
  struct Value {
    double l = 0, kg = 0, kn = 0, tau_g = 0, B_perp = 0;
  };

  virtual ~LineDensity() = default;
  virtual Value at(const CurveGeometry& c) const = 0;
};

/// kappa_l + kappa_g kg + kappa_tau tau_g + kappa_n kn, and the same of the squares.
class LinePolynomial : public LineDensity {
public:
  explicit LinePolynomial(const Line& moduli) : m_(moduli) {}

  Value at(const CurveGeometry& c) const override {
    const double g = m_.geodesic_square_modulus * c.kg, n = m_.normal_square_modulus * c.kn,
                 t = m_.torsion_square_modulus * c.tau_g;
    Value v;
    v.l = m_.tension + (m_.geodesic_modulus + g) * c.kg + (m_.normal_modulus + n) * c.kn +
          (m_.torsion_modulus + t) * c.tau_g + m_.perpendicular_modulus * c.B_perp;
    v.kg = m_.geodesic_modulus + 2 * g;
    v.kn = m_.normal_modulus + 2 * n;
    v.tau_g = m_.torsion_modulus + 2 * t;
    v.B_perp = m_.perpendicular_modulus;
    return v;
  }

private:
  Line m_;
};

/// The sum of two.
class LineSum : public LineDensity {
public:
  using Part = std::shared_ptr<const LineDensity>;

  LineSum(Part a, Part b) : a_(std::move(a)), b_(std::move(b)) {}

  Value at(const CurveGeometry& c) const override {
    const Value a = a_->at(c), b = b_->at(c);
    return {a.l + b.l, a.kg + b.kg, a.kn + b.kn, a.tau_g + b.tau_g, a.B_perp + b.B_perp};
  }

private:
  Part a_, b_;
};

} // namespace lamella
