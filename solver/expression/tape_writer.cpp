#include "expression/tape_writer.h"

#include "error.h"
#include "expression/known_functions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace lamella {
namespace {

double finite(double x) {
  if (!std::isfinite(x))
    throw FormulaError("a coefficient of it is not finite; allowed: smaller numbers");
  return x;
}

double number_of(const GiNaC::ex& e) {
  const GiNaC::ex value = e.evalf();
  if (!GiNaC::is_a<GiNaC::numeric>(value) || !GiNaC::ex_to<GiNaC::numeric>(value).is_real())
    throw FormulaError("a coefficient of it is no real number; allowed: roots and logarithms of "
                       "what is not negative");
  return finite(GiNaC::ex_to<GiNaC::numeric>(value).to_double());
}

Function function_of(const GiNaC::ex& e) {
  const std::string name = GiNaC::ex_to<GiNaC::function>(e).get_name();
  return std::ranges::find(known_functions(), name, &KnownFunction::name)->function;
}

} // namespace

TapeWriter::TapeWriter(std::span<const GiNaC::symbol> variables)
    : variables_(static_cast<int>(variables.size())) {
  for (int i = 0; i < variables_; ++i) terms_[variables[static_cast<std::size_t>(i)]] = {1, i};
}

Tape TapeWriter::tape(std::span<const GiNaC::ex> results) {
  std::vector<int> values;
  for (const GiNaC::ex& result : results) {
    const Term t = term(result);
    // A constant is 0 times a variable and the constant: so it is of the variables' kind.
    values.push_back(t.value == none ? affine({0, 0}, t.factor) : affine(t, 0));
  }
  return {variables_, steps_, values};
}

TapeWriter::Term TapeWriter::term(const GiNaC::ex& e) {
  const auto known = terms_.find(e);
  return known != terms_.end() ? known->second : terms_[e] = new_term(e);
}

TapeWriter::Term TapeWriter::new_term(const GiNaC::ex& e) {
  if (GiNaC::is_a<GiNaC::add>(e)) return sum(e);
  if (GiNaC::is_a<GiNaC::mul>(e)) return product(e);
  if (GiNaC::is_a<GiNaC::power>(e)) return power(e.op(0), e.op(1));
  if (GiNaC::is_a<GiNaC::function>(e)) return function(e);
  return {number_of(e)};
}

/// Computed with its first summand positive: GiNaC writes x - y or -(y - x) as it happens.
TapeWriter::Term TapeWriter::sum(const GiNaC::ex& e) {
  double constant = 0, sign = 0;
  Term all;
  for (const GiNaC::ex& summand : sorted(e)) {
    Term t = term(summand);
    if (t.value == none) {
      constant += t.factor;
      continue;
    }
    if (sign == 0) sign = t.factor < 0 ? -1 : 1;
    t.factor *= sign;
    if (all.value == none)
      all = t;
    else
      all = {1, t.factor == 1 ? added(t.value, all) : added(affine(all, 0), t)};
  }
  return {sign, affine(all, sign * constant)};
}

TapeWriter::Term TapeWriter::product(const GiNaC::ex& e) {
  Term all{1};
  for (const GiNaC::ex& factor : sorted(e)) {
    const Term t = term(factor);
    all.factor *= t.factor;
    if (t.value == none) continue;
    all.value = all.value == none ? t.value : step({Tape::Operation::multiply, all.value, t.value});
  }
  return {finite(all.factor), all.value};
}

/// Exponents are whole numbers or these divided by 2, 4, ...
TapeWriter::Term TapeWriter::power(const GiNaC::ex& base, const GiNaC::ex& exponent) {
  Term b = term(base);
  const double number = number_of(exponent);
  if (b.value == none) return {finite(std::pow(b.factor, number))};
  const int root = GiNaC::ex_to<GiNaC::numeric>(exponent).denom().to_int();
  if (root > 1) b = {1, affine(b, 0)};
  for (int r = root; r > 1; r /= 2) b.value = applied(Function::sqrt, b.value);
  if (number < 0) b.value = applied(Function::reciprocal, b.value);
  return {finite(std::pow(b.factor, number)),
          whole_power(b.value, static_cast<int>(std::abs(number) * root))};
}

TapeWriter::Term TapeWriter::function(const GiNaC::ex& e) {
  const Function f = function_of(e);
  const Term argument = term(e.op(0));
  if (argument.value == none) return {finite(lamella::apply(f, argument.factor))};
  return {1, applied(f, affine(argument, 0))};
}

int TapeWriter::whole_power(int value, int exponent) {
  if (exponent == 1) return value;
  const int root =
      exponent % 2 == 0 ? whole_power(value, exponent / 2) : whole_power(value, exponent - 1);
  return step({Tape::Operation::multiply, root, exponent % 2 == 0 ? root : value});
}

int TapeWriter::added(int value, const Term& term) {
  return step({Tape::Operation::add_scaled, value, term.value, finite(term.factor)});
}

/// The term and a constant as a value.
int TapeWriter::affine(const Term& term, double constant) {
  if (term.factor == 1 && constant == 0) return term.value;
  return step({Tape::Operation::affine, term.value, 0, finite(term.factor), finite(constant)});
}

int TapeWriter::applied(Function function, int value) {
  return step({Tape::Operation::apply, value, 0, 1, 0, function});
}

int TapeWriter::step(const Tape::Step& step) {
  const auto [known, is_new] =
      values_.try_emplace(step, variables_ + static_cast<int>(steps_.size()));
  if (is_new) steps_.push_back(step);
  return known->second;
}

std::vector<GiNaC::ex> TapeWriter::sorted(const GiNaC::ex& e) {
  std::vector<GiNaC::ex> operands(e.begin(), e.end());
  std::ranges::sort(operands, {}, [&](const GiNaC::ex& operand) { return name_of(operand).text; });
  return operands;
}

const TapeWriter::Name& TapeWriter::name_of(const GiNaC::ex& e) {
  const auto known = names_.find(e);
  return known != names_.end() ? known->second : names_[e] = new_name(e);
}

TapeWriter::Name TapeWriter::new_name(const GiNaC::ex& e) {
  if (GiNaC::is_a<GiNaC::symbol>(e)) return {1, GiNaC::ex_to<GiNaC::symbol>(e).get_name()};
  if (GiNaC::is_a<GiNaC::add>(e)) return name_of_sum(e);
  if (GiNaC::is_a<GiNaC::mul>(e)) return name_of_product(e);
  if (e.nops() == 0) return {number_of(e), ""};
  const auto& [factor, text] = name_of(e.op(0));
  if (GiNaC::is_a<GiNaC::function>(e))
    return {1, fmt::format("{}({}*{})", GiNaC::ex_to<GiNaC::function>(e).get_name(), factor, text)};
  const double exponent = number_of(e.op(1));
  if (e.op(1).info(GiNaC::info_flags::integer))
    return {std::pow(factor, exponent), fmt::format("({})^{}", text, exponent)};
  return {1, fmt::format("({}*{})^{}", factor, text, exponent)};
}

TapeWriter::Name TapeWriter::name_of_sum(const GiNaC::ex& e) {
  std::vector<Name> parts;
  for (const GiNaC::ex& summand : e) parts.push_back(name_of(summand));
  std::ranges::sort(parts, {}, &Name::text);
  std::string text;
  const auto first =
      std::ranges::find_if(parts, [](const Name& part) { return !part.text.empty(); });
  const double sign = first->factor < 0 ? -1 : 1;
  for (const Name& part : parts) text += fmt::format("+{}*{}", sign * part.factor, part.text);
  return {sign, "(" + text + ")"};
}

TapeWriter::Name TapeWriter::name_of_product(const GiNaC::ex& e) {
  double factor = 1;
  std::vector<std::string> parts;
  for (const GiNaC::ex& operand : e) {
    const Name& name = name_of(operand);
    factor *= name.factor;
    if (!name.text.empty()) parts.push_back(name.text);
  }
  std::ranges::sort(parts);
  return {factor, fmt::format("{}", fmt::join(parts, "*"))};
}

} // namespace lamella
