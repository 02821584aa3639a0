// What an ExactNumber is inside. For exact_number*.cc only.
#pragma once

#include <gmpxx.h>

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "corank/core/exact_number.h"

namespace corank {

// Canonical form, kept by the constructors below:
//   sum      value + Σ operands (none a sum or a rational; at least one, at least two where value = 0; of few operands no
//            two that differ by a rational factor alone)
//   product  value · Π operands (none a product, a rational or, alone beside a rational, a sum; no √q twice, q rational;
//            value ≠ 0, negative powers last; at least two where value = 1)
//   power    operands[0]^exponent, exponent ∉ {0, 1}, the base no rational
struct ExactNumber::Node {
  enum class Kind { rational, pi, sum, product, power, function };
  Kind kind = Kind::rational;
  mpq_class value;
  ConstantFunction function = ConstantFunction::sqrt;
  int exponent = 1;
  std::vector<std::shared_ptr<const Node>> operands;

  static ExactNumber number(mpq_class q);  ///< canonical
  static ExactNumber of(std::shared_ptr<const Node> node) { return ExactNumber(std::move(node)); }
};

/// Of each ConstantFunction, as in the model language.
inline constexpr std::array kFunctionNames{"sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "exp", "log", "abs"};
inline const char* function_name(ConstantFunction f) { return kFunctionNames.at(static_cast<std::size_t>(f)); }

}  // namespace corank
