#include "expression/formula_text.h"

#include "error.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace lamella {
namespace {

constexpr std::size_t longest_formula = 2000; // characters
constexpr std::string_view blanks = " \t\r\n";

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

} // namespace

std::size_t name_length(std::string_view text) {
  std::size_t n = 0;
  while (n < text.size() &&
         (is_letter(text[n]) || (n > 0 && (is_digit(text[n]) || text[n] == '_'))))
    ++n;
  return n;
}

std::vector<Token> FormulaText::tokens() const {
  if (text_.size() > longest_formula)
    refuse(text_, fmt::format("longer than {} characters; allowed: a short formula, which may use "
                              "named numbers",
                              longest_formula));
  std::vector<Token> tokens;
  std::size_t at = 0;
  while ((at = text_.find_first_not_of(blanks, at)) != text_.npos) {
    tokens.push_back(token(at));
    at += tokens.back().text.size();
  }
  if (tokens.empty()) refuse(text_, "no formula; allowed: one such as KM^2");
  tokens.push_back({Token::Kind::end, text_.substr(text_.size())});
  return tokens;
}

void FormulaText::refuse(std::string_view at, const std::string& message) const {
  const std::string_view before =
      text_.substr(0, static_cast<std::size_t>(at.data() - text_.data()));
  const std::size_t line_end = before.rfind('\n');
  const std::size_t column = before.size() - (line_end == before.npos ? 0 : line_end + 1) + 1;
  const std::string line = text_.find('\n') == text_.npos
                               ? ""
                               : fmt::format("line {}, ", std::ranges::count(before, '\n') + 1);
  throw FormulaError(fmt::format("{}column {}: {}", line, column, message));
}

Token FormulaText::token(std::size_t begin) const {
  const char c = text_[begin];
  if (is_letter(c)) return name(begin);
  if (is_digit(c) || c == '.') return number(begin);
  if (std::string_view("+-*/^(),").find(c) == std::string_view::npos) refuse_sign(begin);
  if (text_.substr(begin, 2) == "**") refuse(text_.substr(begin), "** is no power; allowed: ^");
  return {Token::Kind::sign, text_.substr(begin, 1)};
}

Token FormulaText::number(std::size_t begin) const {
  const std::string_view rest = text_.substr(begin);
  double value = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  const std::string_view text = rest.substr(0, static_cast<std::size_t>(end - rest.data()));
  if (error == std::errc::result_out_of_range)
    refuse(rest,
           fmt::format("{} is out of range; allowed: numbers from about 1e-308 to 1e308", text));
  if (error != std::errc{}) refuse(rest, "a dot without digits; allowed: a number such as 0.5");
  return {Token::Kind::number, text, value};
}

Token FormulaText::name(std::size_t begin) const {
  const std::string_view rest = text_.substr(begin);
  return {Token::Kind::name, rest.substr(0, name_length(rest))};
}

void FormulaText::refuse_sign(std::size_t at) const {
  const std::string_view rest = text_.substr(at);
  const char c = rest.front();
  const std::string allowed = "; allowed: numbers, names, + - * / ^ and round brackets";
  if (c == '=') refuse(rest, "a formula has no =; allowed: only what stands right of it");
  if (c < 0x20 || c > 0x7e) refuse(rest, "a character that formulas do not have" + allowed);
  refuse(rest, fmt::format("{} has no meaning in a formula{}", c, allowed));
}

} // namespace lamella
