#include "corank/symbolic/sets/free_coordinates.h"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <functional>
#include <map>

#include "corank/core/rounding.h"
#include "corank/symbolic/algebra/exact_value.h"
#include "corank/symbolic/algebra/expression_range.h"
#include "corank/symbolic/velocity/exact_matrix.h"

namespace corank::symbolic {
namespace {

bool is_in_range(const Mechanism& mechanism, const Coordinate& c, const Interval& value) {
  const Interval lower = exact_value(mechanism, c.lower, c.name).enclose();
  const Interval upper = exact_value(mechanism, c.upper, c.name).enclose();
  return lower.hi() < value.lo() && value.hi() < upper.lo();
}

// Its ends may be two constants with the same value.
bool has_one_value(const Mechanism& mechanism, const Coordinate& c) {
  return c.has_range && (exact_value(mechanism, c.upper, c.name) - exact_value(mechanism, c.lower, c.name)).is_zero();
}

bool has_given(const FreeCoordinates& free, const std::vector<Expression>& functions) {
  return std::ranges::any_of(functions, [&](const Expression& e) {
    return std::ranges::any_of(free.given, [&](const Relation& r) { return e.mentions(r.lhs.name()); });
  });
}

std::vector<std::string> mentioned(const std::vector<Coordinate>& coordinates, const Expression& e) {
  std::vector<std::string> result;
  for (const Coordinate& c : coordinates)
    if (e.mentions(c.name)) result.push_back(c.name);
  return result;
}

// Does the expression have the name within a sine, or another function?
bool has_in_function(const Expression& e, const std::string& name) {
  if (e.kind() == Expression::Kind::function) return e.mentions(name);
  return std::ranges::any_of(e.operands(), [&](const Expression& part) { return has_in_function(part, name); });
}

// The theorem's hypothesis; the equations' polynomials do not show what is within sines.
bool gives_a_graph(const std::vector<Relation>& given, const std::vector<Expression>& equations) {
  for (std::size_t k = 0; k < given.size(); ++k) {
    const std::string& name = given[k].lhs.name();
    if (given[k].rhs.mentions(name)) return false;
    for (std::size_t i = 0; i < k; ++i)
      if (equations[i].mentions(name)) return false;
    if (std::ranges::any_of(equations, [&](const Expression& e) { return has_in_function(e, name); })) return false;
  }
  return true;
}

}  // namespace

std::optional<FreeCoordinates> free_coordinates(const Mechanism& mechanism) {
  const auto varies = [&](const Expression& e) { return !mechanism.toleranced_in(e).empty(); };
  for (const Coordinate& c : mechanism.coordinates())
    if (c.has_range && (varies(c.lower) || varies(c.upper))) return std::nullopt;
  const std::vector<Expression> equations = residuals(mechanism);
  const ExactMatrix none(mechanism, {}, equations);
  if (!none.is_explicit()) return std::nullopt;
  FreeCoordinates result{plain_system(mechanism), none.given()};
  if (!gives_a_graph(result.given, equations)) return std::nullopt;
  TrigonometricSystem& system = result.system;
  const std::vector<Coordinate> within_limits = system.coordinates;
  system.equations.clear();
  system.claimed.clear();
  std::map<std::string, Expression> values;
  for (const Relation& r : result.given) values.emplace(r.lhs.name(), r.rhs.substituted(values));
  std::erase_if(system.coordinates, [&](const Coordinate& c) { return values.contains(c.name); });
  for (Coordinate& c : system.coordinates)
    if (has_one_value(mechanism, c)) c.upper = c.lower;  // is_fixed() looks no closer
  for (auto& inequality : system.inequalities) {
    inequality.relation = inequality.relation.substituted(values);
    if (mentioned(system.coordinates, inequality.relation.lhs - inequality.relation.rhs).empty()) return std::nullopt;
  }

  // Does the range of a given coordinate cut anything off?
  const UpwardRounding rounding;
  std::map<std::string, Interval> ranges;
  for (const Coordinate& c : system.coordinates)
    ranges[c.name] = Interval(exact_value(mechanism, c.lower, c.name).enclose().lo(),
                              exact_value(mechanism, c.upper, c.name).enclose().hi());
  const std::function<std::optional<Interval>(const Expression&)> known =
      [&](const Expression& e) -> std::optional<Interval> {
    if (e.is_named_function() && (e.name() == "sin" || e.name() == "cos")) return Interval(-1, 1);
    if (e.kind() != Expression::Kind::symbol) return std::nullopt;
    if (const auto own = ranges.find(e.name()); own != ranges.end()) return own->second;
    const auto exact = [&](const Expression& value) { return exact_value(mechanism, value, e.name()).enclose(); };
    if (!varies(e)) return exact(e);
    const Constant& c = *std::ranges::find(mechanism.constants(), e.name(), &Constant::name);
    return c.tolerance ? Interval::hull(exact(c.tolerance->lower), exact(c.tolerance->upper)) : range_of(c.value, known);
  };
  for (const Relation& r : result.given) {
    const std::string& name = r.lhs.name();
    const int index = mechanism.find_coordinate(name);
    const Coordinate& c = mechanism.coordinates()[index];
    if (has_one_value(mechanism, c)) return std::nullopt;
    const bool is_limited = std::ranges::find(mechanism.limits(), name, &Limit::coordinate) != mechanism.limits().end();
    const Expression& value = values.at(name);
    if (!is_limited) {
      if (!c.has_range) continue;  // its range is what the equations say
      const bool is_constant = mentioned(system.coordinates, value).empty();
      const std::optional<Interval> range =
          is_constant && !varies(value) ? exact_value(mechanism, value, name).enclose() : range_of(value, known);
      if (range && is_in_range(mechanism, c, *range)) continue;
      if (is_constant) return std::nullopt;
      if (within_limits[index].within_one && is_in_range(mechanism, c, Interval(-1, 1))) continue;
    }
    system.inequalities.push_back({value >= within_limits[index].lower, "lower end of " + name, c.where});
    system.inequalities.push_back({value <= within_limits[index].upper, "upper end of " + name, c.where});
  }
  return result;
}

std::optional<TrigonometricSystem> mentioned_coordinates(const FreeCoordinates& free,
                                                         const std::vector<Expression>& functions) {
  if (has_given(free, functions)) return std::nullopt;
  TrigonometricSystem system = free.system;
  std::erase_if(system.coordinates, [&](const Coordinate& c) {
    return !is_fixed(c) && std::ranges::none_of(functions, [&](const Expression& e) { return e.mentions(c.name); }) &&
           std::ranges::none_of(system.inequalities, [&](const TrigonometricSystem::Equation& e) {
             return e.relation.lhs.mentions(c.name) || e.relation.rhs.mentions(c.name);
           });
  });
  return system;
}

std::optional<std::vector<IndependentPart>> independent_parts(const FreeCoordinates& free,
                                                              const std::vector<Expression>& functions) {
  const std::vector<Coordinate>& all = free.system.coordinates;
  if (has_given(free, functions)) return std::nullopt;
  const auto place = [&](const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(all, name, &Coordinate::name) - all.begin());
  };
  boost::disjoint_sets_with_storage<> tied(all.size());
  std::vector<bool> asked(all.size(), false);
  // One of the coordinates that it is about; as many as there are: none.
  const auto tie = [&](const Expression& e) {
    std::size_t first = all.size();
    for (const std::string& name : mentioned(all, e)) {
      const std::size_t k = place(name);
      asked[k] = true;
      if (is_fixed(all[k])) continue;  // a number
      if (first < all.size()) tied.union_set(first, k);
      first = k;
    }
    return first;
  };
  std::vector<std::size_t> of_function, of_inequality;
  for (const Expression& f : functions) of_function.push_back(tie(f));
  for (const auto& e : free.system.inequalities) of_inequality.push_back(tie(e.relation.lhs - e.relation.rhs));
  std::map<std::size_t, std::size_t> numbers;
  std::vector<IndependentPart> parts;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!asked[k] || is_fixed(all[k])) continue;
    const auto [own, fresh] = numbers.emplace(tied.find_set(k), parts.size());
    if (!fresh) continue;
    parts.push_back({free.system, {}});
    parts.back().system.coordinates.clear();
    parts.back().system.inequalities.clear();
  }
  if (parts.empty()) return std::nullopt;
  const auto part_of = [&](std::size_t k) { return k < all.size() ? numbers.at(tied.find_set(k)) : 0; };
  for (std::size_t i = 0; i < functions.size(); ++i) parts[part_of(of_function[i])].functions.push_back(i);
  for (std::size_t i = 0; i < of_inequality.size(); ++i)
    parts[part_of(of_inequality[i])].system.inequalities.push_back(free.system.inequalities[i]);
  for (IndependentPart& part : parts)
    for (const Coordinate& c : all) {
      const auto about = [&](const Expression& e) { return e.mentions(c.name); };
      if (std::ranges::any_of(part.functions, [&](std::size_t i) { return about(functions[i]); }) ||
          std::ranges::any_of(part.system.inequalities,
                              [&](const auto& e) { return about(e.relation.lhs) || about(e.relation.rhs); }))
        part.system.coordinates.push_back(c);
    }
  return parts;
}

}  // namespace corank::symbolic
