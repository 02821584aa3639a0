#include "corank/symbolic/model/mechanism.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <unordered_set>

#include "corank/core/check.h"
#include "corank/symbolic/model/expression_words.h"
#include "corank/symbolic/model/model_validator.h"
#include "corank/symbolic/model/requirement_text.h"

namespace corank::symbolic {
namespace {

std::string declared_at(const SourceLocation& where) {
  return where.line > 0 ? " in line " + std::to_string(where.line) : std::string();
}

}  // namespace

bool is_no_end(const Constraint& inequality) {
  return inequality.note.starts_with("choice of ") || inequality.note.starts_with("slice of ");
}

bool is_fixed(const Coordinate& coordinate) { return coordinate.has_range && same_tree(coordinate.lower, coordinate.upper); }

bool hold(std::vector<Coordinate>& coordinates, const std::string& name, const Expression& value) {
  const auto c = std::ranges::find(coordinates, name, &Coordinate::name);
  if (c == coordinates.end()) return false;
  c->lower = c->upper = value, c->has_range = true;
  return true;
}

void Mechanism::require(const std::string& text, const SourceLocation& where) {
  parse_requirement(text, where);
  // It is to be one line of a model, with a semicolon behind it.
  if (text.find_first_of(";%") != text.npos || text.find("//") != text.npos || text.find("/*") != text.npos)
    throw ModelError(where, "the requirement " + in_quotes(text) + " has a comment in it", "one without");
  std::string line = text;
  std::ranges::replace_if(
      line, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  requirements_.push_back({line, where});
}

std::vector<std::string> Mechanism::requirement_texts() const {
  std::vector<std::string> texts;
  for (const RequirementLine& r : requirements_) texts.push_back(r.text);
  return texts;
}

Mechanism Mechanism::without_rates() const {
  Mechanism result = *this;
  for (const Rate& rate : rates_) result.names_.erase(rate.name);
  result.rates_.clear();
  result.velocity_equations_.clear();
  result.drawing_ = {};
  return result;
}

Mechanism Mechanism::without(const std::vector<std::string>& coordinates) const {
  const std::unordered_set<std::string> names(coordinates.begin(), coordinates.end());
  const auto stands_in = [&](const Constraint& c) {
    return std::ranges::any_of(
        names, [&](const std::string& name) { return c.relation.lhs.mentions(name) || c.relation.rhs.mentions(name); });
  };
  Mechanism result = without_rates();
  for (auto* list : {&result.constraints_, &result.implied_}) std::erase_if(*list, stands_in);
  std::erase_if(result.coordinates_, [&](const Coordinate& c) { return names.contains(c.name); });
  std::erase_if(result.limits_, [&](const Limit& limit) { return names.contains(limit.coordinate); });
  std::erase_if(result.composites_, [&](const Composite& c) {
    return std::ranges::any_of(c.components, [&](const std::string& name) { return names.contains(name); });
  });
  for (auto* list : {&result.inputs_, &result.outputs_})
    std::erase_if(*list, [&](const std::string& name) { return names.contains(name); });
  std::erase_if(result.names_, [](const auto& entry) { return entry.second.kind != Declared::constant; });
  const auto register_names = [&](const auto& things, Declared kind) {
    for (std::size_t k = 0; k < things.size(); ++k)
      result.names_.emplace(things[k].name, Declaration{kind, k, things[k].where});
  };
  register_names(result.coordinates_, Declared::coordinate);
  register_names(result.composites_, Declared::composite);
  return result;
}

void Mechanism::declare(const std::string& name, Declared kind, const SourceLocation& where) {
  const std::string expectation = kind == Declared::constant ? "another name for the constant"
                                  : kind == Declared::rate   ? "another name for the rate"
                                                             : "another name for the variable";
  if (!is_identifier(name))
    throw ModelError(where, in_quotes(name) + " is not a name", "letters, digits and _, not beginning with a digit");
  if (is_reserved(name)) throw ModelError(where, "the name " + in_quotes(name) + " is reserved", expectation);
  if (const auto found = names_.find(name); found != names_.end())
    throw ModelError(where, "the name " + in_quotes(name) + " is already declared" + declared_at(found->second.where),
                     expectation);
  const std::size_t index = kind == Declared::constant     ? constants_.size()
                            : kind == Declared::coordinate ? coordinates_.size()
                            : kind == Declared::composite  ? composites_.size()
                                                           : rates_.size();
  names_.emplace(name, Declaration{kind, index, where});
}

Expression Mechanism::constant(const std::string& name, const Expression& value, const SourceLocation& where,
                               const std::optional<Tolerance>& tolerance) {
  if (name == "deg" && same_tree(value, degrees("1"))) return value;  // it is that in every model
  declare(name, Declared::constant, where);
  constants_.push_back({name, value, where, tolerance});
  return Expression::symbol(name);
}

std::string Mechanism::toleranced_in(const Expression& e) const {
  for (const Constant& c : constants_) {
    if (!e.mentions(c.name)) continue;
    if (c.tolerance) return c.name;
    if (std::string name = toleranced_in(c.value); !name.empty()) return name;
  }
  return {};
}

Mechanism Mechanism::nominal() const {
  Mechanism result = *this;
  for (Constant& c : result.constants_) c.tolerance.reset();
  return result;
}

Expression Mechanism::coordinate(const Coordinate& c) {
  declare(c.name, Declared::coordinate, c.where);
  coordinates_.push_back(c);
  return Expression::symbol(c.name);
}

std::vector<Expression> Mechanism::compose(Composite::Kind kind, const std::string& name,
                                           const std::vector<std::string>& suffixes, const SourceLocation& where) {
  declare(name, Declared::composite, where);
  composites_.push_back({kind, name, {}, where});
  std::vector<Expression> components;
  for (const std::string& suffix : suffixes) {
    components.push_back(length(name + "_" + suffix, -1, 1, where));
    coordinates_.back().direction = true;
    composites_.back().components.push_back(components.back().name());
  }
  return components;
}

std::vector<Expression> Mechanism::unit_vector(const std::string& name, const SourceLocation& where) {
  const std::vector<Expression> w = compose(Composite::Kind::unit, name, {"x", "y", "z"}, where);
  constrain(pow(w[0], 2) + pow(w[1], 2) + pow(w[2], 2) == Expression(1), where, name + " @ unit");
  return w;
}

std::vector<Expression> Mechanism::rotation(const std::string& name, const SourceLocation& where) {
  const std::vector<Expression> r =
      compose(Composite::Kind::rotation, name, {"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"}, where);
  const auto column = [&r](std::size_t j) { return std::array{r[j], r[3 + j], r[6 + j]}; };
  const auto a = column(0), b = column(1), c = column(2);
  const std::string note = name + " @ rotation";
  for (const auto& axis : {a, b})
    constrain(pow(axis[0], 2) + pow(axis[1], 2) + pow(axis[2], 2) == Expression(1), where, note);
  constrain(a[0] * b[0] + a[1] * b[1] + a[2] * b[2] == Expression(0), where, note);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    constrain(c[i] == a[j] * b[k] - a[k] * b[j], where, note);
  }
  return r;
}

void Mechanism::mark_auxiliary(std::size_t coordinates) {
  for (std::size_t i = 1; i <= coordinates; ++i) coordinates_.at(coordinates_.size() - i).auxiliary = true;
}

void Mechanism::constrain(const Relation& relation, const SourceLocation& where, const std::string& note) {
  constraints_.push_back({relation, where, note});
}

void Mechanism::imply(const Relation& relation, const SourceLocation& where) {
  if (relation.kind != Relation::Kind::equal)
    throw ModelError(where, "an inequality cannot be an implied equation", "lhs = rhs");
  implied_.push_back({relation, where});
}

Expression Mechanism::rate(const std::string& name, CoordinateKind kind, Role role, const SourceLocation& where) {
  declare(name, Declared::rate, where);
  rates_.push_back({name, kind, role, where});
  return Expression::symbol(name);
}

void Mechanism::velocity(const Relation& relation, const SourceLocation& where) {
  if (relation.kind != Relation::Kind::equal)
    throw ModelError(where, "an inequality cannot be a velocity equation", "lhs = rhs");
  velocity_equations_.push_back({relation, where});
}

std::vector<std::string> Mechanism::chosen(Role role, const std::vector<Expression>& symbols, const SourceLocation& where,
                                           std::vector<std::string> before, const std::vector<std::string>& others) const {
  const std::string own = to_string(role), other = to_string(role == Role::input ? Role::output : Role::input);
  const std::unordered_set<std::string> taken(others.begin(), others.end());
  std::unordered_set<std::string> seen(before.begin(), before.end());
  for (const Expression& symbol : symbols) {
    const auto refuse = [&](const std::string& what, const std::string& problem, const std::string& expectation) {
      throw ModelError(symbol.where_or(where), "the " + own + " " + in_quotes(what) + " is " + problem, expectation);
    };
    const std::string expectation = "a variable of the model";
    if (symbol.kind() != Expression::Kind::symbol) refuse(symbol.text(), "not a name", expectation);
    if (has_constant(symbol.name())) refuse(symbol.name(), "a constant", expectation);
    if (find_rate(symbol.name()) >= 0) refuse(symbol.name(), "a rate, whose role is given in [RATES]", expectation);
    const Composite* const composite = find_composite(symbol.name());
    if (!composite && find_coordinate(symbol.name()) < 0) refuse(symbol.name(), "not declared", expectation);
    for (const std::string& name : composite ? composite->components : std::vector{symbol.name()}) {
      if (!seen.insert(name).second) refuse(name, "named twice", "each " + own + " once");
      if (taken.contains(name)) refuse(name, "already an " + other, "a variable that is not an " + other);
      before.push_back(name);
    }
  }
  return before;
}

void Mechanism::inputs(const std::vector<Expression>& symbols, const SourceLocation& where) {
  inputs_ = chosen(Role::input, symbols, where, inputs_, outputs_);
  if (inputs_where_.line == 0 && !symbols.empty()) inputs_where_ = symbols[0].where_or(where);
}

void Mechanism::outputs(const std::vector<Expression>& symbols, const SourceLocation& where) {
  outputs_ = chosen(Role::output, symbols, where, outputs_, inputs_);
  if (outputs_where_.line == 0 && !symbols.empty()) outputs_where_ = symbols[0].where_or(where);
}

void Mechanism::replace_outputs(const std::vector<Expression>& symbols, const SourceLocation& where) {
  outputs_ = chosen(Role::output, symbols, where, {}, {});
  std::erase_if(inputs_, [&](const std::string& name) { return std::ranges::find(outputs_, name) != outputs_.end(); });
  outputs_where_ = where;
}

void Mechanism::limit(const std::string& coordinate, const Expression& lower, const Expression& upper,
                      const SourceLocation& where) {
  if (find_coordinate(coordinate) < 0)
    throw ModelError(where,
                     "the limit of " + in_quotes(coordinate) +
                         (has_constant(coordinate)     ? ", which is a constant"
                          : find_composite(coordinate) ? ", which is not a single coordinate"
                          : find_rate(coordinate) >= 0 ? ", which is a rate"
                                                       : ", which is not declared"),
                     "a variable of the model");
  for (const Limit& other : limits_)
    if (other.coordinate == coordinate)
      throw ModelError(where, in_quotes(coordinate) + " is limited twice" + declared_at(other.where),
                       "one limit for each variable");
  limits_.push_back({coordinate, lower, upper, where});
}

void Mechanism::set_constant(const std::string& name, const Expression& value, const std::optional<Tolerance>& tolerance) {
  if (!has_constant(name))
    throw ModelError({name_, 0, 0}, "there is no constant " + in_quotes(name),
                     constants_.empty() ? "a model with constants" : "one of " + joined(names_of(constants_)));
  Constant& constant = constants_[names_.at(name).index];
  constant.value = value;
  constant.tolerance = tolerance;
}

std::vector<std::string> Mechanism::toleranced() const {
  std::vector<std::string> names;
  for (const Constant& c : constants_)
    if (c.tolerance) names.push_back(c.name);
  return names;
}

void Mechanism::set_range(const std::string& coordinate, const Expression& lower, const Expression& upper) {
  const int index = find_coordinate(coordinate);
  if (index < 0 || coordinates_[index].direction)
    throw ModelError({name_, 0, 0}, in_quotes(coordinate) + " has no range of its own",
                     "a coordinate that is not part of a unit vector or rotation matrix");
  Coordinate& c = coordinates_[index];
  c.lower = lower, c.upper = upper, c.has_range = true;
}

void Mechanism::reach(const Relation& inequality) {
  const auto is_it = [&](const Constraint& c) { return same_relation(c.relation, inequality); };
  const auto first = std::ranges::find_if(constraints_, is_it);
  CORANK_CHECK(first != constraints_.end());
  Constraint equation = *first;
  equation.relation.kind = Relation::Kind::equal;
  std::erase_if(constraints_, is_it);
  constraints_.push_back(std::move(equation));
}

void Mechanism::unroll(const std::string& angle, const Expression& lower, const Expression& upper) {
  set_range(angle, lower, upper);
  coordinates_[find_coordinate(angle)].kind = CoordinateKind::length;
}

int Mechanism::find(const std::string& name, Declared kind) const {
  const auto found = names_.find(name);
  return found == names_.end() || found->second.kind != kind ? -1 : static_cast<int>(found->second.index);
}

const Composite* Mechanism::find_composite(const std::string& name) const {
  const int index = find(name, Declared::composite);
  return index < 0 ? nullptr : &composites_[index];
}

std::vector<Constraint> Mechanism::equations() const {
  std::vector<Constraint> result;
  std::copy_if(constraints_.begin(), constraints_.end(), std::back_inserter(result),
               [](const Constraint& c) { return c.relation.kind == Relation::Kind::equal; });
  return result;
}

bool Mechanism::is_plain_system() const {
  return inputs_.empty() && outputs_.empty() &&
         std::ranges::all_of(rates_, [](const Rate& rate) { return rate.role == Role::passive; });
}

void Mechanism::validate_rates(const ModelValidator& validator) const {
  if (rates_.empty() && velocity_equations_.empty()) return;
  if (rates_.empty())
    throw ModelError(velocity_equations_[0].where, "the model has velocity equations but no rates",
                     "[RATES], which declares them");
  if (velocity_equations_.empty())
    throw ModelError(rates_[0].where, "the model has rates but no velocity equations", "at least one, in [VELOCITY EQS]");
  for (const Constraint& c : velocity_equations_) validator.check_velocity_equation(c);
  const std::size_t equation_count = equations().size();
  const auto difference = [](std::size_t a, std::size_t b) { return static_cast<long>(a) - static_cast<long>(b); };
  const long by_rates = difference(rates_.size(), velocity_equations_.size()),
             by_coordinates = difference(coordinates_.size(), equation_count);
  if (by_rates == by_coordinates) return;
  const auto give = [](const std::string& unknowns, const std::string& conditions, long mobility) {
    return unknowns + " and " + conditions + " give mobility " + std::to_string(mobility);
  };
  throw ModelError(velocity_equations_[0].where,
                   give(counted(rates_.size(), "rate"), counted(velocity_equations_.size(), "velocity equation"), by_rates) +
                       ", but " +
                       give(counted(coordinates_.size(), "coordinate"), counted(equation_count, "equation"), by_coordinates),
                   "the same mobility from both");
}

void Mechanism::validate() const {
  ModelValidator validator(*this);
  for (const Constant& c : constants_) validator.add_constant(c);
  for (const Coordinate& c : coordinates_)
    if (c.has_range) validator.check_range(c);
  for (const Limit& l : limits_)
    for (const Expression& end : {l.lower, l.upper})
      validator.check_value(end, "the limit of " + in_quotes(l.coordinate), l.where);
  for (const Constraint& c : constraints_) validator.check_constraint(c);
  for (const Constraint& c : implied_) validator.check_constraint(c);
  for (const DrawingPoint& p : drawing_.points) validator.check_point(p);
  for (const DrawingPart& p : drawing_.parts) validator.check_part(p);
  drawing_.validate();
  validate_rates(validator);
  if (coordinates_.empty()) throw ModelError({name_, 0, 0}, "the model has no variables", "at least one, in [SYSTEM VARS]");
  if (constraints_.empty() && rates_.empty())
    throw ModelError({name_, 0, 0}, "the model has no equations", "at least one, in [SYSTEM EQS]");
}

}  // namespace corank::symbolic
