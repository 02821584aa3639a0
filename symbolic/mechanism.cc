#include "corank/symbolic/mechanism.h"

#include <unordered_set>

#include "corank/symbolic/expression_words.h"
#include "corank/symbolic/model_validator.h"

namespace corank::symbolic {
namespace {

std::string declared_at(const SourceLocation& where) {
  return where.line > 0 ? " in line " + std::to_string(where.line) : std::string();
}

SourceLocation place(const Expression& e, const SourceLocation& otherwise) {
  return e.where().line > 0 ? e.where() : otherwise;
}

}  // namespace

void Mechanism::declare(const std::string& name, bool is_constant, const SourceLocation& where) {
  const std::string expectation = is_constant ? "another name for the constant" : "another name for the variable";
  if (!is_identifier(name)) {
    throw ModelError(where, in_quotes(name) + " is no name", "letters, digits and _, beginning with no digit");
  }
  if (is_reserved(name)) throw ModelError(where, "the name " + in_quotes(name) + " is reserved", expectation);
  if (const auto found = names_.find(name); found != names_.end()) {
    const auto [old_is_constant, index] = found->second;
    throw ModelError(where,
                     "the name " + in_quotes(name) + " is already declared" +
                         declared_at(old_is_constant ? constants_[index].where : coordinates_[index].where),
                     expectation);
  }
  names_.emplace(name, Declaration{is_constant, is_constant ? constants_.size() : coordinates_.size()});
}

Expression Mechanism::constant(const std::string& name, const Expression& value, const SourceLocation& where) {
  declare(name, true, where);
  constants_.push_back({name, value, where});
  return Expression::symbol(name);
}

Expression Mechanism::length(const std::string& name, const Expression& lower, const Expression& upper,
                             const SourceLocation& where) {
  declare(name, false, where);
  coordinates_.push_back({name, CoordinateKind::length, lower, upper, where});
  return Expression::symbol(name);
}

Expression Mechanism::angle(const std::string& name, const Expression& lower, const Expression& upper,
                            const SourceLocation& where) {
  declare(name, false, where);
  coordinates_.push_back({name, CoordinateKind::angle, lower, upper, where});
  return Expression::symbol(name);
}

void Mechanism::mark_auxiliary() { coordinates_.at(coordinates_.size() - 1).auxiliary = true; }

void Mechanism::constrain(const Relation& relation, const SourceLocation& where) {
  constraints_.push_back({relation, where});
}

void Mechanism::choose(const std::string& role, const std::vector<Expression>& symbols, const SourceLocation& where,
                       std::vector<std::string>& chosen, const std::string& other_role,
                       const std::vector<std::string>& others) const {
  const std::unordered_set<std::string> taken(others.begin(), others.end());
  std::unordered_set<std::string> seen(chosen.begin(), chosen.end());
  std::vector<std::string> result = chosen;
  for (const Expression& symbol : symbols) {
    const SourceLocation at = place(symbol, where);
    const std::string expectation = "a variable of the model";
    if (symbol.kind() != Expression::Kind::symbol) {
      throw ModelError(at, "the " + role + " " + in_quotes(symbol.text()) + " is no name", expectation);
    }
    const std::string& name = symbol.name();
    if (has_constant(name)) throw ModelError(at, "the " + role + " " + in_quotes(name) + " is a constant", expectation);
    if (find_coordinate(name) < 0)
      throw ModelError(at, "the " + role + " " + in_quotes(name) + " is not declared", expectation);
    if (!seen.insert(name).second) {
      throw ModelError(at, "the " + role + " " + in_quotes(name) + " is named twice", "each " + role + " once");
    }
    if (taken.contains(name)) {
      throw ModelError(at, "the " + role + " " + in_quotes(name) + " is already an " + other_role,
                       "a variable that is no " + other_role);
    }
    result.push_back(name);
  }
  chosen = std::move(result);
}

void Mechanism::inputs(const std::vector<Expression>& symbols, const SourceLocation& where) {
  choose("input", symbols, where, inputs_, "output", outputs_);
  if (inputs_where_.line == 0 && !symbols.empty()) inputs_where_ = place(symbols[0], where);
}

void Mechanism::outputs(const std::vector<Expression>& symbols, const SourceLocation& where) {
  choose("output", symbols, where, outputs_, "input", inputs_);
  if (outputs_where_.line == 0 && !symbols.empty()) outputs_where_ = place(symbols[0], where);
}

void Mechanism::set_constant(const std::string& name, const Expression& value) {
  if (!has_constant(name)) {
    std::string known;
    for (const Constant& c : constants_) known += (known.empty() ? "" : ", ") + c.name;
    throw ModelError({name_, 0, 0}, "there is no constant " + in_quotes(name),
                     known.empty() ? "a model with constants" : "one of " + known);
  }
  constants_[names_.at(name).index].value = value;
}

int Mechanism::find_coordinate(const std::string& name) const {
  const auto found = names_.find(name);
  return found == names_.end() || found->second.is_constant ? -1 : static_cast<int>(found->second.index);
}

bool Mechanism::has_constant(const std::string& name) const {
  const auto found = names_.find(name);
  return found != names_.end() && found->second.is_constant;
}

void Mechanism::validate() const {
  ModelValidator validator(*this);
  for (const Constant& c : constants_) validator.add_constant(c);
  for (const Coordinate& c : coordinates_) validator.check_range(c);
  for (const Constraint& c : constraints_) validator.check_constraint(c);
  for (const DrawingPoint& p : drawing_.points) validator.check_point(p);
  drawing_.validate();
  if (coordinates_.empty()) throw ModelError({name_, 0, 0}, "the model has no variables", "at least one, in [SYSTEM VARS]");
  if (constraints_.empty()) throw ModelError({name_, 0, 0}, "the model has no equations", "at least one, in [SYSTEM EQS]");
}

}  // namespace corank::symbolic
