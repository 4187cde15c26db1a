#pragma once
#include "expression/functions.h"

#include <span>
#include <vector>

namespace lamella {

/// A computation of several results from some variables, step by step. It never changes, so that
/// threads may share it.
class Tape {
public:
  enum class Operation {
    add_scaled, ///< left + number * right
    multiply,   ///< left * right
    affine,     ///< number * left + offset
    apply       ///< function(left)
  };

  /// One operation on values, which are numbered: the variables, then what each step gives.
  struct Step {
    Operation operation;
    int left, right = 0;
    double number = 1, offset = 0;
    Function function = Function::reciprocal;
    auto operator<=>(const Step&) const = default;
  };

  Tape() = default;
  /// `results` names a value for each result.
  Tape(int variables, std::vector<Step> steps, std::vector<int> results);

  bool operator==(const Tape&) const = default;

  int variables() const { return variables_; }
  int results() const { return static_cast<int>(results_.size()); }
  int steps() const { return static_cast<int>(steps_.size()); }
  /// Values that must be kept at once, besides the variables.
  int registers() const { return registers_; }

  /// The results at `variables`. T is a number, several side by side (Lanewise) or
  /// what is Composable; of it are used T + T, T * T, double * T, T + double and apply(Function,
  /// T). `registers` is room to work in, which the first call makes; each thread needs its own.
  template <class T>
  void evaluate(std::span<const T> variables, std::span<T> results,
                std::vector<T>& registers) const {
    registers.resize(static_cast<std::size_t>(registers_));
    const Values<T> values{variables, registers};
    for (std::size_t i = 0; i < steps_.size(); ++i)
      registers[static_cast<std::size_t>(targets_[i])] = result_of(steps_[i], values);
    for (std::size_t i = 0; i < results_.size(); ++i) results[i] = values[results_[i]];
  }

private:
  template <class T>
  struct Values {
    std::span<const T> variables;
    const std::vector<T>& registers;

    const T& operator[](int i) const {
      const auto n = static_cast<std::size_t>(i);
      return n < variables.size() ? variables[n] : registers[n - variables.size()];
    }
  };

  template <class T>
  static T result_of(const Step& step, const Values<T>& values) {
    const T& left = values[step.left];
    switch (step.operation) {
    case Operation::add_scaled:
      return left + step.number * values[step.right];
    case Operation::multiply:
      return left * values[step.right];
    case Operation::affine:
      return step.number * left + step.offset;
    default:
      return apply(step.function, left);
    }
  }

  // Values are numbered by where they are kept: the variables, then the registers.
  int variables_ = 0, registers_ = 0;
  std::vector<Step> steps_;
  std::vector<int> targets_; ///< the register that each step's value goes to
  std::vector<int> results_;
};

} // namespace lamella
