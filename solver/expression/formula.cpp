#include "expression/formula.h"

#include "error.h"
#include "expression/formula_text.h"
#include "expression/known_functions.h"
#include "expression/tape_writer.h"
#include "nearest.h"

#include <cln/dfloat.h>
#include <cln/real.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ginac/ginac.h>

#include <algorithm>
#include <mutex>
#include <numbers>
#include <optional>

// GiNaC differentiates and simplifies. Its own reader is not used: it does not say where a mistake
// is, and computes 9^9^9 in full. Here whatever is constant stays a double, checked at each
// operation, and becomes an exact fraction where it meets a variable: sums of fractions do not
// depend on the order that GiNaC adds them in.

namespace lamella {
namespace {

constexpr int deepest_nesting = 100;
constexpr double highest_degree = 64;

/// What a part of a formula is: a number, or something of variables.
struct Part {
  std::optional<double> number;
  GiNaC::ex symbolic; ///< also where it is a number
  double degree = 0;  ///< of a polynomial of this form; bounds the lengths of coefficients
};

GiNaC::ex exact(double x) {
  if (std::fpclassify(x) == FP_SUBNORMAL) return 0;
  return GiNaC::numeric(cln::rational(cln::cl_DF(x)));
}

bool has_variables(const GiNaC::ex& e) {
  return std::any_of(e.preorder_begin(), e.preorder_end(),
                     [](const GiNaC::ex& part) { return GiNaC::is_a<GiNaC::symbol>(part); });
}

/// Nothing for what is complex.
std::optional<double> real_value(const GiNaC::ex& constant) {
  const GiNaC::ex value = constant.evalf();
  if (!GiNaC::is_a<GiNaC::numeric>(value)) return {};
  const auto& number = GiNaC::ex_to<GiNaC::numeric>(value);
  return number.is_real() ? std::optional(number.to_double()) : std::nullopt;
}

bool is_whole(double x) { return std::rint(x) == x; }

/// What else one may write, and what to write instead.
struct Advice {
  std::string_view name, text;
};
constexpr std::string_view not_smooth =
    "is not smooth, which the force of a membrane asks for; allowed: smooth functions, such as "
    "sqrt(x^2 + d^2) for the size and tanh(x/d) for the sign of x, with a small d";
constexpr Advice advices[] = {
    {"abs", not_smooth},
    {"fabs", not_smooth},
    {"sign", not_smooth},
    {"sgn", not_smooth},
    {"step", not_smooth},
    {"heaviside", not_smooth},
    {"min", not_smooth},
    {"max", not_smooth},
    {"floor", not_smooth},
    {"ceil", not_smooth},
    {"round", not_smooth},
    {"mod", not_smooth},
    {"if", not_smooth},
    {"pow", "is written with ^; allowed: x^2"},
    {"ln", "is written log; allowed: log(x)"},
    {"cbrt", "is written as a power; allowed: x^(1/3)"},
    {"e", "is written exp; allowed: exp(1)"},
};

/// Reads one formula, by descent from sums to numbers and names.
class FormulaReader {
public:
  FormulaReader(std::string_view text, const FormulaNames& names)
      : text_(text), names_(names), tokens_(text_.tokens()), next_(tokens_.begin()) {
    for (const std::string& name : names.variables) variables_.push_back(GiNaC::realsymbol(name));
  }

  GiNaC::ex read() {
    const Part whole = sum();
    if (next_->is(')'))
      text_.refuse(next_->text, "a closing bracket that none opens; allowed: brackets in pairs");
    if (next_->kind != Token::Kind::end) refuse_neighbour(*next_);
    return whole.symbolic;
  }

  const std::vector<GiNaC::symbol>& variables() const { return variables_; }
  const std::set<std::string>& names_read() const { return names_read_; }

private:
  Part sum() {
    Part left = product();
    while (next_->is('+') || next_->is('-')) {
      const Token& sign = take();
      const Part right = product();
      const double degree = std::max(left.degree, right.degree);
      left = sign.is('+') ? combined(sign, left, right, degree, std::plus{})
                          : combined(sign, left, right, degree, std::minus{});
    }
    return left;
  }

  Part product() {
    Part left = factor();
    while (next_->is('*') || next_->is('/')) {
      const Token& sign = take();
      const Part right = factor();
      if (sign.is('/') && right.number == 0.) text_.refuse(sign.text, "a division by zero");
      const double degree = left.degree + right.degree;
      left = sign.is('*') ? combined(sign, left, right, degree, std::multiplies{})
                          : combined(sign, left, right, degree, std::divides{});
    }
    return left;
  }

  /// What ^ makes of an atom, with signs before: -x^2 is -(x^2), and x^-y^z is x^(-(y^z)).
  Part factor() {
    if (++depth_ > deepest_nesting)
      text_.refuse(next_->text, fmt::format("nested too deeply; allowed: {} signs, powers and "
                                            "brackets within each other",
                                            deepest_nesting));
    const Part result = signed_factor();
    --depth_;
    return result;
  }

  Part signed_factor() {
    if (next_->is('+')) return take(), factor();
    if (next_->is('-')) {
      const Token& sign = take();
      const Part positive = factor();
      return combined(sign, number(sign, -1), positive, positive.degree, std::multiplies{});
    }
    const Part base = atom();
    if (!next_->is('^')) return base;
    const Token& sign = take();
    return power(sign, base, factor());
  }

  Part atom() {
    const Token& token = take();
    if (token.kind == Token::Kind::number) return number(token, token.number);
    if (token.kind == Token::Kind::name) return next_->is('(') ? call(token) : named(token);
    if (token.is('(')) return bracketed(token);
    text_.refuse(token.text, fmt::format("a number, a name or an opening bracket belongs {}",
                                         token.kind == Token::Kind::end
                                             ? "here, where the formula ends"
                                             : fmt::format("in the place of {}", token.text)));
  }

  Part bracketed(const Token& opening) {
    const Part inside = sum();
    if (next_->kind == Token::Kind::end)
      text_.refuse(opening.text, "a bracket that is never closed; allowed: brackets in pairs");
    if (!next_->is(')')) refuse_neighbour(*next_);
    take();
    return inside;
  }

  Part named(const Token& token) {
    const std::string name(token.text);
    if (name == "pi") return number(token, std::numbers::pi);
    const auto variable = std::ranges::find(names_.variables, name);
    const auto known = names_.numbers.find(name);
    if (variable == names_.variables.end() && known == names_.numbers.end()) refuse_name(token);
    names_read_.insert(name);
    if (known != names_.numbers.end()) return number(token, known->second);
    return {{}, variables_[static_cast<std::size_t>(variable - names_.variables.begin())], 1};
  }

  Part call(const Token& token) {
    const auto known = std::ranges::find(known_functions(), token.text, &KnownFunction::name);
    if (known == known_functions().end()) refuse_function(token);
    const Part argument = bracketed(take());
    if (argument.number) return number(token, lamella::apply(known->function, *argument.number));
    return symbolic(token, argument.degree, [&] { return known->symbolic(argument.symbolic); });
  }

  Part power(const Token& sign, const Part& base, const Part& exponent) {
    if (base.number && exponent.number)
      return number(sign, std::pow(*base.number, *exponent.number));
    if (exponent.number) return numeric_power(sign, base, *exponent.number);
    if (!base.number)
      text_.refuse(sign.text, "an exponent that varies, of what varies; allowed: a number for one "
                              "of them, or exp(y*log(x)) for a positive x");
    if (*base.number <= 0)
      text_.refuse(sign.text,
                   "an exponent that varies, of what is not positive; allowed: a positive number");
    return symbolic(sign, exponent.degree,
                    [&] { return GiNaC::exp(exponent.symbolic * exact(std::log(*base.number))); });
  }

  Part numeric_power(const Token& sign, const Part& base, double exponent) {
    if (exponent == 0) return number(sign, 1);
    const double degree = base.degree * std::max(1., std::abs(exponent));
    return symbolic(sign, degree, [&]() -> GiNaC::ex {
      if (is_whole(2 * exponent))
        return GiNaC::pow(base.symbolic, GiNaC::numeric(static_cast<long>(2 * exponent), 2L));
      return GiNaC::exp(exact(exponent) * GiNaC::log(base.symbolic));
    });
  }

  template <class Operation>
  Part combined(const Token& sign, const Part& left, const Part& right, double degree,
                Operation operation) const {
    if (left.number && right.number) return number(sign, operation(*left.number, *right.number));
    return symbolic(sign, degree,
                    [&]() -> GiNaC::ex { return operation(left.symbolic, right.symbolic); });
  }

  Part number(const Token& at, double x) const {
    if (!std::isfinite(x))
      text_.refuse(at.text, fmt::format("{:.60} gives no finite real number here", at.text));
    return {x, exact(x), 0};
  }

  /// What `make` gives, which may have turned out a number.
  template <class Make>
  Part symbolic(const Token& at, double degree, Make make) const {
    if (degree > highest_degree)
      text_.refuse(at.text, fmt::format("a power of {:g}, counting powers of powers and products; "
                                        "allowed: up to {:g}",
                                        degree, highest_degree));
    std::optional<double> constant;
    try {
      const GiNaC::ex e = make();
      if (has_variables(e)) return {{}, e, std::max(degree, 1.)};
      constant = real_value(e);
    } catch (const std::exception&) { // GiNaC's: a division by zero, a logarithm of zero
    }
    return number(at, constant.value_or(NAN));
  }

  const Token& take() { return next_->kind == Token::Kind::end ? *next_ : *next_++; }

  std::vector<std::string_view> all_names() const {
    std::vector<std::string_view> all(names_.variables.begin(), names_.variables.end());
    for (const auto& [name, value] : names_.numbers) all.push_back(name);
    all.push_back("pi");
    return all;
  }

  static std::vector<std::string_view> function_names() {
    std::vector<std::string_view> all;
    for (const KnownFunction& known : known_functions()) all.push_back(known.name);
    return all;
  }

  [[noreturn]] void refuse_neighbour(const Token& token) const {
    if (token.is(','))
      text_.refuse(token.text, "a comma; allowed: functions of one number, and 0.5 for a half");
    text_.refuse(token.text, fmt::format("no operator before {:.60}; allowed: + - * / ^, as in 2*x",
                                         token.text));
  }

  void advise(const Token& token) const {
    const auto advice = std::ranges::find(advices, token.text, &Advice::name);
    if (advice != std::end(advices))
      text_.refuse(token.text, fmt::format("{} {}", advice->name, advice->text));
  }

  [[noreturn]] void refuse_name(const Token& token) const {
    if (std::ranges::count(function_names(), token.text) > 0)
      text_.refuse(token.text, fmt::format("{0} is a function; allowed: {0}(x)", token.text));
    advise(token);
    const auto names = all_names();
    text_.refuse(token.text, fmt::format("unknown name {:.60}; allowed: {}{}", token.text,
                                         fmt::join(names, ", "), suggestion(token.text, names)));
  }

  [[noreturn]] void refuse_function(const Token& token) const {
    if (std::ranges::count(all_names(), token.text) > 0)
      text_.refuse(token.text, fmt::format("{0} is no function; allowed: {0}*( ... )", token.text));
    advise(token);
    const auto names = function_names();
    text_.refuse(token.text, fmt::format("unknown function {:.60}; allowed: {}{}", token.text,
                                         fmt::join(names, ", "), suggestion(token.text, names)));
  }

  FormulaText text_;
  const FormulaNames& names_;
  std::vector<GiNaC::symbol> variables_;
  std::vector<Token> tokens_;
  std::vector<Token>::const_iterator next_;
  std::set<std::string> names_read_;
  int depth_ = 0;
};

GiNaC::ex differentiated(GiNaC::ex e, const DifferentiatedBy& by, const FormulaNames& names,
                         std::span<const GiNaC::symbol> variables) {
  for (const std::string& name : by) {
    const auto variable = std::ranges::find(names.variables, name) - names.variables.begin();
    e = e.diff(variables[static_cast<std::size_t>(variable)]);
  }
  return e;
}

std::set<std::string> dependences(const GiNaC::ex& e) {
  std::set<std::string> names;
  for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part)
    if (GiNaC::is_a<GiNaC::symbol>(*part))
      names.insert(GiNaC::ex_to<GiNaC::symbol>(*part).get_name());
  return names;
}

} // namespace

std::span<const KnownFunction> known_functions() {
  using GiNaC::ex;
  static const KnownFunction functions[] = {
      {"sqrt", Function::sqrt, [](const ex& x) -> ex { return GiNaC::sqrt(x); }},
      {"exp", Function::exp, [](const ex& x) -> ex { return GiNaC::exp(x); }},
      {"log", Function::log, [](const ex& x) -> ex { return GiNaC::log(x); }},
      {"sin", Function::sin, [](const ex& x) -> ex { return GiNaC::sin(x); }},
      {"cos", Function::cos, [](const ex& x) -> ex { return GiNaC::cos(x); }},
      {"tan", Function::tan, [](const ex& x) -> ex { return GiNaC::tan(x); }},
      {"sinh", Function::sinh, [](const ex& x) -> ex { return GiNaC::sinh(x); }},
      {"cosh", Function::cosh, [](const ex& x) -> ex { return GiNaC::cosh(x); }},
      {"tanh", Function::tanh, [](const ex& x) -> ex { return GiNaC::tanh(x); }},
      {"atan", Function::atan, [](const ex& x) -> ex { return GiNaC::atan(x); }},
  };
  return functions;
}

Formula read_formula(std::string_view text, const FormulaNames& names,
                     const std::vector<DifferentiatedBy>& results) {
  static std::mutex one_reads; // GiNaC counts references without locks
  const std::lock_guard lock(one_reads);
  FormulaReader reader(text, names);
  const GiNaC::ex formula = reader.read();
  try {
    std::vector<GiNaC::ex> wanted;
    Formula read{{}, reader.names_read(), {}};
    for (const DifferentiatedBy& by : results) {
      wanted.push_back(differentiated(formula, by, names, reader.variables()));
      read.dependences.push_back(dependences(wanted.back()));
    }
    read.tape = TapeWriter(reader.variables()).tape(wanted);
    return read;
  } catch (const FormulaError&) {
    throw;
  } catch (const std::exception&) { // CLN's, for numbers that no double holds
    throw FormulaError("a coefficient of it is out of range; allowed: numbers and powers that "
                       "make coefficients from about 1e-308 to 1e308");
  }
}

bool is_free_name(std::string_view name) {
  return !name.empty() && name_length(name) == name.size() && name != "pi" &&
         std::ranges::count(known_functions(), name, &KnownFunction::name) == 0;
}

} // namespace lamella
