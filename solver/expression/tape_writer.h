#pragma once
#include "expression/tape.h"

#include <ginac/ginac.h>

#include <map>
#include <span>
#include <string>
#include <vector>

namespace lamella {

/// Turns symbolic results into one tape. What occurs twice is computed once; powers with whole
/// exponents are products. The order of operations depends on names alone, not, as GiNaC's does, on
/// where things lie in memory: the same text gives the same tape, to the last bit of its results,
/// in every process. Only sources of this folder include this.
class TapeWriter {
public:
  explicit TapeWriter(std::span<const GiNaC::symbol> variables);

  /// Throws FormulaError for coefficients that are not finite and real.
  Tape tape(std::span<const GiNaC::ex> results);

private:
  /// factor * value, or the factor alone where there is no value.
  struct Term {
    double factor = 0;
    int value = none;
  };
  static constexpr int none = -1;

  /// factor * what the text says. Operands are sorted by the text, which does not depend on the
  /// sign that GiNaC gives a sum.
  struct Name {
    double factor;
    std::string text; ///< empty for a number
  };

  Term term(const GiNaC::ex& e);
  Term new_term(const GiNaC::ex& e);
  Term sum(const GiNaC::ex& e);
  Term product(const GiNaC::ex& e);
  Term power(const GiNaC::ex& base, const GiNaC::ex& exponent);
  Term function(const GiNaC::ex& e);
  int whole_power(int value, int exponent);
  int added(int value, const Term& term);
  int affine(const Term& term, double constant);
  int step(const Tape::Step& step);
  int applied(Function function, int value);

  std::vector<GiNaC::ex> sorted(const GiNaC::ex& e);
  const Name& name_of(const GiNaC::ex& e);
  Name new_name(const GiNaC::ex& e);
  Name name_of_sum(const GiNaC::ex& e);
  Name name_of_product(const GiNaC::ex& e);

  std::map<GiNaC::ex, Term, GiNaC::ex_is_less> terms_;
  std::map<GiNaC::ex, Name, GiNaC::ex_is_less> names_;
  std::map<Tape::Step, int> values_;
  std::vector<Tape::Step> steps_;
  int variables_;
};

} // namespace lamella
