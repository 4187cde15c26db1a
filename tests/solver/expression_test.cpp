// Formulas written as text: what they come to, what their derivatives come to, and what is refused.
#include "error.h"
#include "expression/formula.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <complex>
#include <numbers>
#include <random>
#include <thread>

namespace lamella {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const FormulaNames membrane{{"KM", "K"}, {{"a", 3}, {"C0", -2}, {"tiny", 1e-300}}};

template <class T>
std::vector<T> at(const Tape& tape, const std::vector<T>& variables) {
  std::vector<T> results(static_cast<std::size_t>(tape.results())), registers;
  tape.evaluate<T>(variables, results, registers);
  return results;
}

double value(std::string_view text, double KM = 0.7, double K = 0.4) {
  return at<double>(read_formula(text, membrane).tape, {KM, K}).front();
}

std::string refusal(std::string_view text, const std::vector<DifferentiatedBy>& results = {{}}) {
  try {
    read_formula(text, membrane, results);
  } catch (const FormulaError& e) {
    return e.what();
  }
  return "accepted";
}

/// A number with its first two derivatives along a line: closed under +, * and functions, as jets
/// on the membrane are.
struct Taylor {
  double f, first = 0, second = 0;
};
Taylor operator+(const Taylor& a, const Taylor& b) {
  return {a.f + b.f, a.first + b.first, a.second + b.second};
}
Taylor operator+(const Taylor& a, double s) { return {a.f + s, a.first, a.second}; }
Taylor operator*(double s, const Taylor& a) { return {s * a.f, s * a.first, s * a.second}; }
Taylor operator*(const Taylor& a, const Taylor& b) {
  return {a.f * b.f, a.first * b.f + a.f * b.first,
          a.second * b.f + 2 * a.first * b.first + a.f * b.second};
}
Taylor compose(double h, double h1, double h2, const Taylor& a) {
  return {h, h1 * a.first, h1 * a.second + h2 * a.first * a.first};
}

/// Formulas that are defined for all numbers, of all operations and functions.
class RandomFormula {
public:
  explicit RandomFormula(unsigned seed) : random_(seed) {}

  std::string text(int depth) {
    const auto part = [&] { return text(depth - 1); };
    const int kind = depth == 0 ? pick(3) : 3 + pick(16);
    switch (kind) {
    case 0:
      return fmt::format("{:.3f}", 0.2 + 0.1 * pick(15));
    case 1:
      return "KM";
    case 2:
      return "K";
    case 3:
    case 4:
      return fmt::format("({} + {})", part(), part());
    case 5:
      return fmt::format("({} - a*{})", part(), part());
    case 6:
    case 7:
      return fmt::format("{}*{}", part(), part());
    case 8:
      return fmt::format("{}/(1 + ({})^2)", part(), part());
    case 9:
      return fmt::format("({})^{}", part(), 2 + pick(2));
    case 10:
      return fmt::format("sqrt(2 + sin({}))", part());
    case 11:
      return fmt::format("(3 + cos({}))^-1.5", part());
    case 12:
      return fmt::format("(2 + tanh({}))^0.3", part());
    case 13:
      return fmt::format("exp(-({})^2)", part());
    case 14:
      return fmt::format("log(1.5 + sin({}))", part());
    case 15:
      return fmt::format("tan(sin({}))", part());
    case 16:
      return fmt::format("sinh(tanh({}))", part());
    case 17:
      return fmt::format("cosh(sin({}))", part());
    default:
      return fmt::format("atan({})", part());
    }
  }

private:
  int pick(int n) { return std::uniform_int_distribution(0, n - 1)(random_); }
  std::mt19937 random_;
};

void expect_close(double found, double expected, const std::string& what) {
  EXPECT_NEAR(found, expected, 1e-12 * (1 + std::abs(expected))) << what;
}

TEST(Formula, HasTheValueThatItsTextSays) {
  const double M = 0.7, K = 0.4;
  const std::vector<std::pair<std::string_view, double>> cases{
      {"KM", M},
      {"2", 2},
      {" 0.002*KM^2*K + a*(KM - C0)^2\n", 0.002 * M * M * K + 3 * (M + 2) * (M + 2)},
      {"-KM^2", -M * M},
      {"2^-KM^2", std::pow(2, -M * M)},
      {"2^3^2", 512},
      {"KM - K - 1", M - K - 1},
      {"KM/K/2", M / K / 2},
      {"KM/K*2", M / K * 2},
      {"--KM + +K", M + K},
      {"1e-3*KM + .5 + 2.", 1e-3 * M + 2.5},
      {"KM^0", 1},
      {"KM^a", M * M * M},
      {"KM^(1/3)", std::cbrt(M)},
      {"KM^-2", 1 / (M * M)},
      {"KM^1.5", std::pow(M, 1.5)},
      {"sqrt(sqrt(KM))", std::pow(M, 0.25)},
      {"sqrt((KM - 1)^2)", 0.3},
      {"pi*sin(KM)*cos(K)", std::numbers::pi * std::sin(M) * std::cos(K)},
      {"exp(KM)*log(K)", std::exp(M) * std::log(K)},
      {"tan(KM) + atan(K)", std::tan(M) + std::atan(K)},
      {"sinh(KM)*cosh(K) - tanh(KM)", std::sinh(M) * std::cosh(K) - std::tanh(M)},
      {"(KM - K)^2 + (K - KM)^2", 2 * (M - K) * (M - K)},
      {"KM - KM", 0},
      {"tiny*tiny + KM", M},
      {"exp(sin(1)*pi)", std::exp(std::sin(1) * std::numbers::pi)},
      {"sin(KM - KM + 1)", std::sin(1)},
  };
  for (const auto& [text, expected] : cases)
    EXPECT_NEAR(value(text, M, K), expected, 1e-15 * (1 + std::abs(expected))) << text;
}

TEST(Formula, DerivativesAreThoseOfComplexSteps) {
  const std::vector<DifferentiatedBy> results{{},           {"KM"},      {"K"},
                                              {"KM", "KM"}, {"KM", "K"}, {"K", "K"}};
  constexpr std::complex<double> step{0, 1e-30};
  for (unsigned seed = 0; seed < 300; ++seed) {
    const std::string text = RandomFormula(seed).text(2 + static_cast<int>(seed % 3));
    const Tape tape = read_formula(text, membrane, results).tape;
    const double M = -1.3 + 0.01 * seed, K = 0.9 - 0.007 * seed;
    const auto exact = at<double>(tape, {M, K});
    const auto by_M = at<std::complex<double>>(tape, {M + step, K});
    const auto by_K = at<std::complex<double>>(tape, {M, K + step});
    expect_close(exact[1], by_M[0].imag() / step.imag(), text);
    expect_close(exact[2], by_K[0].imag() / step.imag(), text);
    expect_close(exact[3], by_M[1].imag() / step.imag(), text);
    expect_close(exact[4], by_K[1].imag() / step.imag(), text);
    expect_close(exact[5], by_K[2].imag() / step.imag(), text);
  }
}

TEST(Formula, OfTaylorNumbersHasTheDerivativesThatSymbolsHave) {
  const std::vector<DifferentiatedBy> results{{},           {"KM"},      {"K"},
                                              {"KM", "KM"}, {"KM", "K"}, {"K", "K"}};
  const Taylor KM{-0.8, 1.3, -0.4}, K{0.5, -0.7, 2.1};
  for (unsigned seed = 0; seed < 300; ++seed) {
    const std::string text = RandomFormula(seed).text(2 + static_cast<int>(seed % 3));
    const Tape tape = read_formula(text, membrane, results).tape;
    const auto d = at<double>(tape, {KM.f, K.f});
    const Taylor found = at<Taylor>(tape, {KM, K}).front();
    EXPECT_EQ(found.f, d[0]) << text;
    expect_close(found.first, d[1] * KM.first + d[2] * K.first, text);
    expect_close(found.second,
                 d[1] * KM.second + d[2] * K.second + d[3] * KM.first * KM.first +
                     2 * d[4] * KM.first * K.first + d[5] * K.first * K.first,
                 text);
  }
}

TEST(Formula, OfEightSamplesAtOnceIsThatOfEach) {
  typedef double Lanes __attribute__((vector_size(64)));
  const Lanes KM{-3, -2.5, -1.2, -0.3, 0.4, 1, 1.7, 2}, K{0.1, -0.4, 2, 0.3, 0.7, 1.1, -2, 1.9};
  for (unsigned seed = 0; seed < 100; ++seed) {
    const std::string text = RandomFormula(seed).text(3);
    const Tape tape = read_formula(text, membrane, {{}, {"KM"}, {"K"}}).tape;
    const auto eight = at<Lanes>(tape, {KM, K});
    for (int lane = 0; lane < 8; ++lane) {
      const auto one = at<double>(tape, {KM[lane], K[lane]});
      for (std::size_t i = 0; i < one.size(); ++i) expect_close(eight[i][lane], one[i], text);
    }
  }
}

TEST(Formula, ComputesOnceWhatItsResultsShare) {
  const std::vector<DifferentiatedBy> f_and_partials{{}, {"KM"}, {"K"}};
  // KM^2, KM^4 and its factor, KM^3 and its factor, zero
  EXPECT_EQ(read_formula("0.5*KM^4", membrane, f_and_partials).tape.steps(), 6);
  // KM*K, the function, its square, 1 off that, this times K and KM, and their signs
  EXPECT_EQ(read_formula("tanh(KM*K)", membrane, f_and_partials).tape.steps(), 8);
  EXPECT_EQ(read_formula("exp(KM)", membrane, {{}, {"KM"}, {"KM", "KM"}}).tape.steps(), 1);
  EXPECT_EQ(read_formula("KM^64", membrane).tape.steps(), 6);
}

TEST(Formula, KeepsNoMoreValuesThanItNeeds) {
  std::string text = "KM";
  for (int i = 2; i < 40; ++i) text += fmt::format(" + sin({}*KM)", i);
  const Tape tape = read_formula(text, membrane).tape;
  EXPECT_GT(tape.steps(), 100);
  EXPECT_LE(tape.registers(), 3);
}

TEST(Formula, IsTheSameTapeWheneverItIsRead) {
  const std::string text = RandomFormula(5).text(5);
  const Tape first = read_formula(text, membrane, {{}, {"KM"}, {"K"}}).tape;
  std::vector<std::unique_ptr<char[]>> elsewhere; // moves what GiNaC makes in memory
  for (int i = 0; i < 50; ++i) {
    elsewhere.push_back(std::make_unique<char[]>(static_cast<std::size_t>(8 + 24 * i)));
    read_formula(RandomFormula(static_cast<unsigned>(i)).text(2), membrane);
    EXPECT_EQ(read_formula(text, membrane, {{}, {"KM"}, {"K"}}).tape, first);
  }
}

TEST(Formula, IsReadByManyThreads) {
  const Tape expected = read_formula("tanh(KM)^3*K + a*KM", membrane, {{}, {"KM"}}).tape;
  std::vector<int> equal(4);
  std::vector<std::thread> threads;
  for (int& count : equal)
    threads.emplace_back([&] {
      for (int i = 0; i < 200; ++i)
        count += read_formula("tanh(KM)^3*K + a*KM", membrane, {{}, {"KM"}}).tape == expected;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(equal, testing::Each(200));
}

TEST(Formula, TellsWhichNamesItSpeaksOf) {
  const Formula formula = read_formula("a*KM^2 - 0*K", membrane, {{}, {"KM", "KM"}});
  EXPECT_THAT(formula.names, testing::ElementsAre("K", "KM", "a"));
  EXPECT_THAT(formula.dependences,
              testing::ElementsAre(testing::ElementsAre("KM"), testing::IsEmpty()));
  EXPECT_TRUE(is_free_name("a_1"));
  for (const std::string_view name : {"", "1a", "_a", "a b", "a-b", "pi", "sqrt", "\xce\xba"})
    EXPECT_FALSE(is_free_name(name)) << name;
}

TEST(Formula, IsRefusedWithThePlaceOfAMistake) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "column 1: no formula"},
      {"  \n", "line 1, column 1: no formula"},
      {"KM +", "column 5: a number, a name or an opening bracket belongs here"},
      {"KM + *K", "column 6: a number, a name or an opening bracket belongs in the place of *"},
      {"(KM + K", "column 1: a bracket that is never closed"},
      {"KM + K)", "column 7: a closing bracket that none opens"},
      {"()", "column 2: a number, a name"},
      {"2KM", "column 2: no operator before KM; allowed: + - * / ^, as in 2*x"},
      {"(KM) (K)", "column 6: no operator before ("},
      {"KM\n + 2 K", "line 2, column 6: no operator before K"},
      {"1.2.3", "column 4: no operator before .3"},
      {"KM*.", "column 4: a dot without digits"},
      {"1e999*KM", "column 1: 1e999 is out of range"},
      {"KM**2", "column 3: ** is no power; allowed: ^"},
      {"KM = 2", "column 4: a formula has no =; allowed: only what stands right of it"},
      {"KM + 1,5", "column 7: a comma; allowed: functions of one number"},
      {"tanh(KM, K)", "column 8: a comma"},
      {",", "column 1: a number, a name or an opening bracket belongs in the place of ,"},
      {"[KM]", "column 1: [ has no meaning in a formula"},
      {"\"KM\"", "column 1: \" has no meaning"},
      {"KM!", "column 3: ! has no meaning"},
      {"\xce\xba*KM", "column 1: a character that formulas do not have"},
      {std::string("KM\0", 3), "column 3: a character that formulas do not have"},
      {"KN^2", "column 1: unknown name KN; allowed: KM, K, C0, a, tiny, pi; did you mean \"KM\"?"},
      {"2*km", "column 3: unknown name km; allowed: KM, K, C0, a, tiny, pi; did you mean \"KM\"?"},
      {"I*KM", "column 1: unknown name I"},
      {"Digits", "column 1: unknown name Digits"},
      {"sine(KM)", "column 1: unknown function sine; allowed: sqrt, exp, log, sin, cos, tan, sinh, "
                   "cosh, tanh, atan; did you mean \"sin\"?"},
      {"factorial(9)", "column 1: unknown function factorial"},
      {"1 + sin", "column 5: sin is a function; allowed: sin(x)"},
      {"KM(2)", "column 1: KM is no function; allowed: KM*( ... )"},
      {"abs(KM)", "column 1: abs is not smooth"},
      {"max(KM, K)", "column 1: max is not smooth"},
      {"ln(KM)", "column 1: ln is written log; allowed: log(x)"},
      {"pow(KM, 2)", "column 1: pow is written with ^; allowed: x^2"},
      {"e^KM", "column 1: e is written exp"},
      {"KM^K", "column 3: an exponent that varies, of what varies"},
      {"C0^K", "column 3: an exponent that varies, of what is not positive"},
      {"KM + 1/0", "column 7: a division by zero"},
      {"K/(KM - KM)", "column 2: a division by zero"},
      {"1/(C0 + 2)", "column 2: a division by zero"},
      {"9^9^9*KM", "column 2: ^ gives no finite real number here"},
      {"KM + log(0)", "column 6: log gives no finite real number here"},
      {"sqrt(C0)", "column 1: sqrt gives no finite real number here"},
      {"sqrt(KM - KM - 1)*K", "column 1: sqrt gives no finite real number here"},
      {"exp(exp(exp(a)))*KM", "column 1: exp gives no finite real number here"},
      {"KM^1000000",
       "column 3: a power of 1e+06, counting powers of powers and products; allowed: up "
       "to 64"},
      {"((KM^4)^4)^5", "column 11: a power of 80"},
      {"(-KM^9)^9", "column 8: a power of 81"},
      {"((KM + 1)^60)*K^5", "column 14: a power of 65"},
  };
  for (const auto& [text, message] : cases) EXPECT_THAT(refusal(text), StartsWith(message)) << text;
}

TEST(Formula, IsRefusedWithCoefficientsThatAreNotFinite) {
  for (const char* text : {"(1e30*KM)^20", "(1e300*KM)*1e300", "KM^2/tiny/tiny"})
    EXPECT_THAT(refusal(text), HasSubstr("coefficient")) << text;
}

TEST(Formula, IsRefusedWhereItIsTooLarge) {
  EXPECT_THAT(refusal(std::string(2001, ' ')), HasSubstr("longer than 2000 characters"));
  EXPECT_THAT(refusal(std::string(200, '(') + "KM" + std::string(200, ')')),
              StartsWith("column 101: nested too deeply"));
  EXPECT_THAT(refusal(std::string(500, '-') + "KM"), HasSubstr("nested too deeply"));
  std::string tower = "KM";
  for (int i = 0; i < 200; ++i) tower += "^1";
  EXPECT_THAT(refusal(tower), HasSubstr("nested too deeply"));
}

TEST(Formula, AsLongAsAllowedIsReadAndDifferentiated) {
  std::string product = "(KM + 1)", sum = "sin(KM)", nested = "KM";
  for (int i = 2; i < 60; ++i) product += fmt::format("*(KM + {}*K)", i);
  for (int i = 2; sum.size() < 1980; ++i) sum += fmt::format(" + sin({}*KM)*K", i);
  for (int i = 0; i < 99; ++i) nested = "sin(" + nested + ")";
  const std::vector<DifferentiatedBy> results{{}, {"KM"}, {"K"}, {"KM", "K"}};
  for (const std::string& text : {product, sum, nested})
    EXPECT_EQ(refusal(text, results), "accepted") << text;
}

} // namespace
} // namespace lamella
