#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace lamella {

/// A word of a formula: a number, a name, one of + - * / ^ ( ) and the comma, or its end.
struct Token {
  enum class Kind { number, name, sign, end };

  Kind kind;
  std::string_view text;
  double number = 0;

  bool is(char sign) const { return kind == Kind::sign && text.front() == sign; }
};

/// The text of a formula, which says where something is wrong in it.
class FormulaText {
public:
  explicit FormulaText(std::string_view text) : text_(text) {}

  /// Its words, the last one its end. Throws FormulaError.
  std::vector<Token> tokens() const;

  /// Throw a FormulaError about the part `at`, which is one of the text.
  [[noreturn]] void refuse(std::string_view at, const std::string& message) const;

private:
  Token token(std::size_t begin) const;
  Token number(std::size_t begin) const;
  Token name(std::size_t begin) const;
  [[noreturn]] void refuse_sign(std::size_t at) const;

  std::string_view text_;
};

/// The length of the name that a text begins with: letters, digits and _, a letter first.
std::size_t name_length(std::string_view text);

} // namespace lamella
