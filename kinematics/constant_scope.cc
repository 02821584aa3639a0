#include "corank/kinematics/constant_scope.h"

#include "corank/symbolic/expression_words.h"
#include "corank/symbolic/ginac_lock.h"
#include "corank/symbolic/model_validator.h"
#include "corank/symbolic/polynomial_expander.h"

namespace corank::kinematics {

using symbolic::Expression;
using symbolic::ModelError;
using symbolic::SourceLocation;

struct ConstantScope::State {
  symbolic::GinacLock lock;       ///< released after the values, which are GiNaC's
  symbolic::Mechanism constants;  ///< which knows what a name may be
  symbolic::ModelValidator validator{symbolic::Mechanism()};
  symbolic::PolynomialExpander values;

  symbolic::ConstantValue value(const Expression& e, const std::string& owner, const SourceLocation& where) {
    validator.check_value(e, owner, where);
    return values.constant(e, owner, where);
  }
};

ConstantScope::ConstantScope() : state_(std::make_unique<State>()) {}
ConstantScope::~ConstantScope() = default;
ConstantScope::ConstantScope(ConstantScope&&) noexcept = default;
ConstantScope& ConstantScope::operator=(ConstantScope&&) noexcept = default;

ConstantScope::ConstantScope(const std::vector<symbolic::Constant>& constants) : ConstantScope() {
  for (const symbolic::Constant& constant : constants) define(constant);
}

void ConstantScope::define(const symbolic::Constant& constant) {
  state_->constants.constant(constant.name, constant.value, constant.where);
  state_->validator.add_constant(constant);
  const std::string owner = "the constant " + symbolic::in_quotes(constant.name);
  state_->values.add_constant(constant.name, state_->values.constant(constant.value, owner, constant.where));
}

bool ConstantScope::has(const std::string& name) const { return state_->constants.has_constant(name); }

std::vector<std::string> ConstantScope::names() const {
  std::vector<std::string> result;
  for (const symbolic::Constant& constant : state_->constants.constants()) result.push_back(constant.name);
  return result;
}

void ConstantScope::check(const Expression& e, const std::string& owner, const SourceLocation& where) {
  state_->value(e, owner, where);
}

std::optional<int> ConstantScope::sign(const Expression& e, const std::string& owner, const SourceLocation& where) {
  return state_->value(e, owner, where).sign();
}

std::optional<int> ConstantScope::integer(const Expression& e, const std::string& owner, const SourceLocation& where) {
  return state_->value(e, owner, where).integer();
}

double ConstantScope::approximation(const Expression& e, const std::string& owner, const SourceLocation& where) {
  return state_->value(e, owner, where).exact().enclose().lo();
}

}  // namespace corank::kinematics
