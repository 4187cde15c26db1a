#pragma once
#include "energy/line_density.h"
#include "expression/formula.h"

#include <array>
#include <string>
#include <vector>

namespace lamella {

/// A density of the phase boundary, l(kg, kn, tau_g), that is given as a text, see read_formula;
/// energy / length.
class TextLineDensity : public LineDensity {
public:
  /// `names` of scene/densities.h. Throws FormulaError.
  TextLineDensity(const std::string& text, const FormulaNames& names)
      : tape_(read_formula(text, names, {{}, {"kg"}, {"kn"}, {"tau_g"}}).tape) {}

  Value at(const CurveGeometry& c) const override {
    static thread_local std::vector<double> registers;
    std::array<double, 4> l;
    tape_.evaluate<double>(std::array{c.kg, c.kn, c.tau_g}, l, registers);
    return {.l = l[0], .kg = l[1], .kn = l[2], .tau_g = l[3]};
  }

private:
  Tape tape_;
};

} // namespace lamella
