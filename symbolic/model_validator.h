// Checks that every expression of a mechanism uses only names that may stand where they stand, and that no power in it is so
// large that exact arithmetic could not end: 9^9^9^9 has 10^(3.7·10^8) digits.
#pragma once

#include <string>
#include <unordered_map>

#include "corank/symbolic/mechanism.h"

namespace corank::symbolic {

class ModelValidator {
 public:
  /// Largest |exponent| of a power, and largest degree of an expression, in which constants count with the degree of their
  /// values: a measure of the digits and terms that exact arithmetic would produce.
  static constexpr double kMaxExponent = 1000, kMaxDegree = 100'000;

  explicit ModelValidator(const Mechanism& mechanism);

  /// Checks a constant's value against the constants added before, then adds it. Throws ModelError.
  void add_constant(const Constant& constant);
  /// A range: constants only.
  void check_range(const Coordinate& coordinate) const;
  /// A constraint: constants and coordinates.
  void check_constraint(const Constraint& constraint) const;
  /// A point of the drawing: constants and coordinates, angles inside sin, cos and tan only.
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
  };

  Size check(const Expression& e, const Context& context) const;
  Size check_symbol(const Expression& e, const Context& context) const;
  Size check_power(const Expression& e, const Context& context) const;
  void require_angles_inside_functions(const Expression& e, const Context& context) const;

  std::unordered_map<std::string, Size> constants_;            ///< those added so far
  std::unordered_map<std::string, const Constant*> declared_;  ///< all constants
  std::unordered_map<std::string, const Coordinate*> coordinates_;
  std::unordered_map<std::string, const Composite*> composites_;
};

}  // namespace corank::symbolic
