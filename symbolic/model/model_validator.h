// Checks that every expression of a mechanism uses only names that may stand where they stand, that velocity equations are
// linear and homogeneous in the rates as they are written, and that no power is so
// large that exact arithmetic could not end: 9^9^9^9 has 10^(3.7·10^8) digits.
#pragma once

#include <optional>
#include <string>
#include <unordered_map>

#include "corank/symbolic/model/mechanism.h"

namespace corank::symbolic {

class ModelValidator {
 public:
  /// Largest |exponent| of a power, and largest degree of an expression, in which constants count with the degree of their
  /// values: a measure of the digits and terms that exact arithmetic would produce.
  static constexpr double kMaxExponent = 1000, kMaxDegree = 100'000;

  explicit ModelValidator(const Mechanism& mechanism);

  /// Checks a constant's value against the constants added before, then adds it. Throws ModelError.
  void add_constant(const Constant& constant);
  /// A value of something that messages call `owner`: constants only.
  void check_value(const Expression& value, const std::string& owner, const SourceLocation& where) const;
  /// A range: constants only.
  void check_range(const Coordinate& coordinate) const;
  /// A constraint: constants and coordinates.
  void check_constraint(const Constraint& constraint) const;
  /// Every term of both sides holds one rate, and no rate stands in a function, a power or below a line.
  void check_velocity_equation(const Constraint& equation) const;
  /// A point of the drawing: constants and coordinates, angles inside sin, cos and tan only; of its velocity, all components
  /// are 0 or linear and homogeneous in the rates.
  void check_point(const DrawingPoint& point) const;
  /// A part of the drawing: the radius of a solid is not negative, and no coordinate stands in it.
  void check_part(const DrawingPart& part) const;

 private:
  /// What an expression could grow to.
  struct Size {
    double degree = 1;
    bool constant = true;   ///< no coordinate in it
    long double value = 0;  ///< roughly; means something only where it is constant
  };
  /// Where an expression stands, for messages.
  struct Context {
    std::string owner;  ///< "the constant 'l2'"
    bool constants_only;
    const SourceLocation& where;
    bool rates = false;  ///< may stand there
  };

  Size check(const Expression& e, const Context& context) const;
  Size check_symbol(const Expression& e, const Context& context) const;
  Size check_power(const Expression& e, const Context& context) const;
  /// The degree of an expression in the rates: nothing where its parts differ, or where it is no polynomial in them. A zero
  /// has every degree: `wanted`.
  std::optional<int> rate_degree(const Expression& e, int wanted) const;
  void require_linear_in_rates(const Expression& e, const Context& context) const;
  void require_angles_inside_functions(const Expression& e, const Context& context) const;

  std::unordered_map<std::string, Size> constants_;            ///< those added so far
  std::unordered_map<std::string, const Constant*> declared_;  ///< all constants
  std::unordered_map<std::string, const Coordinate*> coordinates_;
  std::unordered_map<std::string, const Composite*> composites_;
  std::unordered_map<std::string, const Rate*> rates_;
};

}  // namespace corank::symbolic
