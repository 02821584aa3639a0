#include "corank/symbolic/sets/parameters.h"

#include <algorithm>
#include <map>
#include <set>

#include "corank/core/check.h"
#include "corank/core/rounding.h"
#include "corank/symbolic/algebra/exact_value.h"
#include "corank/symbolic/algebra/expression_range.h"
#include "corank/symbolic/model/expression_words.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/cusps_and_nodes.h"
#include "corank/symbolic/sets/kernel_scale.h"
#include "corank/symbolic/sets/limits.h"
#include "corank/symbolic/sets/requirements.h"

namespace corank::symbolic {
namespace {

using Values = std::map<std::string, Expression>;

class Family {
 public:
  Family(const Mechanism& mechanism, TrigonometricSystem system, const std::vector<Parameter>& parameters,
         const std::vector<FixedCoordinate>& fixed)
      : mechanism_(mechanism), place_{mechanism.name(), 0, 0}, parameters_(parameters), fixed_(fixed) {
    out_.system = std::move(system);
  }

  void check(const std::vector<Condition>& conditions) {
    for (const Parameter& p : parameters_) parameter_names_.insert(p.name);
    out_.system.constants = mechanism_.constants();
    split_constants();
    const UpwardRounding rounding;
    for (const Condition& c : conditions) {
      if (is_free(c.value)) continue;
      const Expression value = c.value.substituted(values_);
      if (c.sign == 0)
        refuse("the equations leave out " + value.text() + ", which is 0 for the constants' own values",
               "parameters on which this does not depend: " + remedy());
      const std::optional<Interval> range = try_enclose(value);
      if (range && (c.sign > 0 ? range->lo() > 0 : range->hi() < 0)) continue;
      refuse("the equations hold for " + value.text() + (c.sign > 0 ? " > 0" : " < 0") +
                 ", which is not proven for all values of the parameters",
             "smaller ranges, or other parameters: " + remedy());
    }
  }

  ParametricSystem run() {
    check_names();
    split_constants();
    take_coordinates();
    for (auto* list : {&out_.system.equations, &out_.system.inequalities})
      for (TrigonometricSystem::Equation& e : *list) e.relation = e.relation.substituted(values_);
    out_.system.claimed.clear();  // they serve searches over all variables
    std::erase_if(out_.system.inequalities, [&](const TrigonometricSystem::Equation& e) {
      const bool drops_negatives = e.of_kernel && e.source.starts_with("half-space of ");
      if (drops_negatives) out_.copies *= 2;
      return drops_negatives;
    });
    find_ranges(out_.system);
    return std::move(out_);
  }

 private:
  static std::string remedy() {
    return "corank derive FILE --format model prints these equations as a model whose constants you may change";
  }
  [[noreturn]] void refuse(const std::string& what, const std::string& expected) const {
    throw ModelError(place_, what, expected);
  }

  void check_names() {
    std::set<std::string> seen;
    const auto check = [&](const std::string& name, bool constant_too) {
      const bool is_coordinate = mechanism_.find_coordinate(name) >= 0;
      if (!is_coordinate && !(constant_too && mechanism_.has_constant(name)))
        refuse(in_quotes(name) + " is not in the model", constant_too ? "a constant or a coordinate" : "a coordinate");
      if (!seen.insert(name).second) refuse(in_quotes(name) + " occurs twice", "each name once");
      if (is_coordinate && is_of_pairs())
        refuse("in pairs of configurations " + in_quotes(name) + " would have one value", "a constant");
    };
    for (const Parameter& p : parameters_) check(p.name, true), parameter_names_.insert(p.name);
    for (const FixedCoordinate& f : fixed_) check(f.name, false);
    for (const Limit& limit : mechanism_.limits())
      for (const Parameter& p : parameters_)
        if (depends(limit.lower, p.name) || depends(limit.upper, p.name))
          refuse("the limits of " + in_quotes(limit.coordinate) + " depend on " + in_quotes(p.name),
                 "limits that keep their values");
  }

  bool is_of_pairs() const {
    return std::ranges::any_of(out_.system.coordinates, [&](const Coordinate& c) {
      return std::ranges::any_of(mechanism_.coordinates(),
                                 [&](const Coordinate& own) { return second_name(mechanism_, own.name) == c.name; });
    });
  }

  // Through the constants that are defined by others as well.
  bool depends(const Expression& e, const std::string& name) const {
    if (e.mentions(name)) return true;
    return std::any_of(mechanism_.constants().begin(), mechanism_.constants().end(),
                       [&](const Constant& c) { return c.name != name && e.mentions(c.name) && depends(c.value, name); });
  }

  bool is_free(const Expression& e) const {  // of parameters
    return std::ranges::none_of(parameter_names_, [&](const std::string& name) { return depends(e, name); });
  }

  void split_constants() {
    std::vector<Constant> kept;
    for (const Constant& c : out_.system.constants) {
      if (parameter_names_.contains(c.name)) continue;
      if (is_free(c.value)) {
        kept.push_back(c);
      } else {
        values_[c.name] = c.value.substituted(values_);
      }
    }
    for (const FixedCoordinate& f : fixed_) values_[f.name] = f.value.substituted(values_);
    out_.system.constants = std::move(kept);
    for (const Parameter& p : parameters_) {
      if (!is_free(p.lower) || !is_free(p.upper))
        refuse("the range of " + in_quotes(p.name) + " depends on a parameter", "numbers");
      for (const Expression& end : {p.lower, p.upper})
        if (const std::string name = mechanism_.toleranced_in(end); !name.empty())
          refuse("the range of " + in_quotes(p.name) + " depends on " + in_quotes(name) + ", which has a tolerance",
                 "the same range for all robots");
      ranges_[p.name] = Interval::hull(exact_value(mechanism_, p.lower, p.name).enclose(),
                                       exact_value(mechanism_, p.upper, p.name).enclose());
      if (!(ranges_[p.name].width() > 0) || !ranges_[p.name].is_bounded())
        refuse("the range of " + in_quotes(p.name) + " is not an interval", "two numbers, the lower one first");
    }
  }

  void take_coordinates() {
    const auto is_taken = [&](const Coordinate& c) { return parameter_names_.contains(c.name) || values_.contains(c.name); };
    std::vector<Coordinate>& coordinates = out_.system.coordinates;
    std::erase_if(coordinates, is_taken);
    for (Coordinate& c : coordinates) {
      for (const Coordinate& declared : mechanism_.coordinates())
        if (!declared.has_range && (declared.name == c.name || second_name(mechanism_, declared.name) == c.name))
          c.has_range = false;  // the one that was found belongs to the constants' own values
      if (!c.has_range || (is_free(c.lower) && is_free(c.upper))) continue;
      if (c.kind == CoordinateKind::angle)
        refuse("the range of the angle " + in_quotes(c.name) + " depends on a parameter", "one that does not");
      widen(c);
    }
    for (const Parameter& p : parameters_) {
      coordinates.push_back({p.name, CoordinateKind::length, p.lower, p.upper, place_});
      out_.names.push_back(p.name);
    }
  }

  void widen(Coordinate& c) const {
    const UpwardRounding rounding;
    const Interval range =
        Interval::hull(enclosed(c.lower.substituted(values_), c), enclosed(c.upper.substituted(values_), c));
    if (!range.is_bounded()) refuse("the range of " + in_quotes(c.name) + " is unbounded", "a bounded one");
    c = with_range(c, range);
  }

  // Over all values of the parameters, and of every robot.
  std::optional<Interval> try_enclose(const Expression& e) const {
    return range_of(e, [this](const Expression& part) -> std::optional<Interval> {
      if (is_free(part) && mechanism_.toleranced_in(part).empty()) return exact(part);
      if (part.kind() != Expression::Kind::symbol) return std::nullopt;
      if (const auto known = ranges_.find(part.name()); known != ranges_.end()) return known->second;
      const auto constant = std::ranges::find(mechanism_.constants(), part.name(), &Constant::name);
      if (const auto& t = constant->tolerance) return Interval::hull(exact(t->lower), exact(t->upper));
      return try_enclose(constant->value);
    });
  }
  Interval exact(const Expression& e) const { return exact_value(mechanism_, e, e.text()).enclose(); }
  Interval enclosed(const Expression& e, const Coordinate& of) const {
    if (const std::optional<Interval> range = try_enclose(e)) return *range;
    refuse("the range of " + in_quotes(of.name) + ", " + e.text() + ", is not bounded over the parameters",
           "sums, products and quotients");
  }

  const Mechanism& mechanism_;
  const SourceLocation place_;
  const std::vector<Parameter>& parameters_;
  const std::vector<FixedCoordinate>& fixed_;
  ParametricSystem out_;
  std::set<std::string> parameter_names_;
  Values values_;  // of constants that depend on parameters, and of fixed coordinates
  std::map<std::string, Interval> ranges_;
};

TrigonometricSystem equations_of(const Mechanism& mechanism, const FamilyQuestion& q) {
  if (!q.set) return plain_system(mechanism);
  const SetDefinition& set = definition(q.set);
  if (set.of_parts || set.type)
    throw ModelError({mechanism.name(), 0, 0}, std::string("the set ") + set.name + " cannot be counted",
                     "a set of one system, such as cspace, forward or forward-cusps");
  // Passive rates stay: by how much their scales bound them depends on the constants.
  return singularity_system(mechanism, *q.set, q.kernel, kernel_scales(mechanism, *q.set, q.kernel), q.corank);
}

}  // namespace

void check_conditions(const Mechanism& mechanism, const std::vector<Condition>& conditions,
                      const std::vector<Parameter>& parameters) {
  std::vector<Parameter> constants;
  for (const Parameter& p : parameters)
    if (mechanism.has_constant(p.name)) constants.push_back(p);
  if (!constants.empty()) Family(mechanism, {}, constants, {}).check(conditions);
}

ParametricSystem with_parameters(const Mechanism& mechanism, TrigonometricSystem system,
                                 const std::vector<Parameter>& parameters, const std::vector<FixedCoordinate>& fixed) {
  return Family(mechanism, std::move(system), parameters, fixed).run();
}

std::vector<int> mark_parameters(const ParametricSystem& system, System& polynomials) {
  std::vector<int> indices;
  for (const std::string& name : system.names) {
    indices.push_back(polynomials.find(name));
    CORANK_CHECK(indices.back() >= 0);
    Variable& v = polynomials.variables[indices.back()];
    v.lower_implied = v.upper_implied = true;
  }
  return indices;
}

FamilySystem family_system(const Mechanism& mechanism, const FamilyQuestion& question) {
  const Requirements requirements(mechanism, names_of(question.over));
  TrigonometricSystem equations = equations_of(mechanism, question);
  if (!mechanism.requirements().empty() && definition(question.set).part == LocusPart::nodes)
    throw ModelError({mechanism.name(), 0, 0}, "requirements are asked of one configuration, not of pairs",
                     "a model without requirements, or another set");
  requirements.add_to(equations);
  const ParametricSystem parametric = with_parameters(mechanism, std::move(equations), question.over, question.fixed);
  FamilySystem family{algebrize(parametric.system), {}, parametric.copies};
  family.parameters = mark_parameters(parametric, family.system);
  for (int j = 0; j < family.system.size(); ++j)
    if (family.system.variables[j].is_parameter()) family.parameters.push_back(j);
  family.requirements = requirements.in(family.system);
  return family;
}

}  // namespace corank::symbolic
