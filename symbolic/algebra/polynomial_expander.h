// Turns expressions in lengths, kernel unknowns, and sines and cosines of angles and lengths into polynomials.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "corank/symbolic/algebra/dependent_angle.h"
#include "corank/symbolic/algebra/expanded_polynomial.h"
#include "corank/symbolic/algebra/length_functions.h"
#include "corank/symbolic/model/expression.h"
#include "corank/symbolic/model/mechanism.h"

namespace corank::symbolic {

class PolynomialExpander {
 public:
  /// Largest exponent of an unknown and largest multiple of an angle.
  static constexpr int kMaxExponent = 64;

  /// A constant, in numbers and those defined before. Returns its value.
  const ConstantValue& define(const Constant& constant);
  void add_unknown(const std::string& name, int variable) { unknowns_.emplace(name, variable); }
  void add_angle(const std::string& name, int cosine, int sine) { angles_.emplace(name, AngleVariables{cosine, sine}); }
  /// An angle of one value. It may stand where an angle may, and counts as that constant.
  void add_fixed_angle(const std::string& name, ConstantValue value) { fixed_angles_.emplace(name, std::move(value)); }
  /// sign·other + quarters·π/2, where `other` is an angle with variables.
  void add_dependent_angle(const DependentAngle& angle) { dependent_angles_.emplace(angle.angle, angle); }
  /// Sines and cosines of lengths that polynomials hold, to be settled when all of them are made.
  LengthFunctions& length_functions() { return length_functions_; }

  /// The value of an expression in constants. `what` ("the constant 'l'") and `where` are for messages: every error is a
  /// ModelError at the smallest faulty part.
  ConstantValue constant(const Expression& e, const std::string& what, const SourceLocation& where);
  /// The polynomial of an expression. Throws ModelError for all that algebrize() lists.
  ExpandedPolynomial polynomial(const Expression& e, const std::string& what, const SourceLocation& where);

 private:
  struct AngleVariables {
    int cosine, sine;
  };
  /// Σ multiples[θ]·θ + offset, with angles and lengths θ: what may stand inside a sine or a cosine.
  struct LinearForm {
    std::map<std::string, ConstantValue> multiples;
    ConstantValue offset;
  };
  /// cos α and sin α.
  using CosineAndSine = std::pair<ExpandedPolynomial, ExpandedPolynomial>;

  ExpandedPolynomial expand(const Expression& e);
  ExpandedPolynomial expand_symbol(const Expression& e);
  ExpandedPolynomial expand_quotient(const Expression& e);
  ExpandedPolynomial expand_power(const Expression& e);
  ExpandedPolynomial expand_function(const Expression& e);
  ExpandedPolynomial expand_sine_or_cosine(const Expression& e);
  LinearForm linear_form(const Expression& e);
  int whole_multiple(const Expression& e, const std::string& angle, const ConstantValue& multiple) const;
  CosineAndSine of_constant(const Expression& argument, const ConstantValue& value);
  CosineAndSine of_lengths(const std::map<std::string, ConstantValue>& multiples);
  bool is_angle(const std::string& name) const {
    return angles_.contains(name) || fixed_angles_.contains(name) || dependent_angles_.contains(name);
  }
  bool has_unknown(const Expression& e) const;
  /// What an expression without unknowns is worth.
  ConstantValue value(const Expression& e);
  [[noreturn]] void fail(const Expression& e, const std::string& problem, const std::string& expectation = "") const;
  template <typename Compute>
  auto guarded(const Expression& e, Compute&& compute) const;

  std::map<std::string, ConstantValue> constants_;
  std::map<std::string, int> unknowns_;
  std::map<std::string, AngleVariables> angles_;
  std::map<std::string, ConstantValue> fixed_angles_;
  std::map<std::string, DependentAngle> dependent_angles_;
  std::map<std::string, CosineAndSine> of_constants_;  // by the argument's text: a fixed angle occurs in many terms
  LengthFunctions length_functions_;
  std::string what_;      // being expanded, for messages
  SourceLocation where_;  // its place
};

}  // namespace corank::symbolic
