// What expressions in a robot's constants are worth, exactly.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corank/symbolic/algebra/ginac_lock.h"
#include "corank/symbolic/algebra/polynomial_expander.h"
#include "corank/symbolic/model/model_validator.h"

namespace corank::kinematics {

using symbolic::Expression;
using symbolic::SourceLocation;

/// Every function throws ModelError for a name that is no constant defined before, an absurd power, and what is no real
/// number; with the expression's place where it has one, else `where`. Messages call the expression `owner`.
/// A scope holds a GinacLock while it lives, and dies in the thread that made it.
class ConstantScope {
 public:
  explicit ConstantScope(const std::vector<symbolic::Constant>& constants = {}) {
    for (const symbolic::Constant& constant : constants) define(constant);
  }

  /// Throws also for a name that is taken or reserved.
  void define(const symbolic::Constant& constant) {
    constants_.constant(constant.name, constant.value, constant.where);
    validator_.add_constant(constant);
    values_.define(constant);
  }
  bool has(const std::string& name) const { return constants_.has_constant(name); }
  std::vector<std::string> names() const { return symbolic::names_of(constants_.constants()); }

  symbolic::ConstantValue value(const Expression& e, const std::string& owner, const SourceLocation& where) {
    validator_.check_value(e, owner, where);
    return values_.constant(e, owner, where);
  }
  /// Nothing where enclosures leave it open: it may be 0.
  std::optional<int> sign(const Expression& e, const std::string& owner, const SourceLocation& where) {
    return value(e, owner, where).sign();
  }
  /// Close to the value; for drawing.
  double approximation(const Expression& e, const std::string& owner, const SourceLocation& where) {
    return value(e, owner, where).exact().enclose().lo();
  }

 private:
  symbolic::GinacLock lock_;       ///< released after the values, which are GiNaC's
  symbolic::Mechanism constants_;  ///< which knows what a name may be
  symbolic::ModelValidator validator_{symbolic::Mechanism()};
  symbolic::PolynomialExpander values_;
};

}  // namespace corank::kinematics
