#include "corank/symbolic/sets/reached_inequalities.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::symbolic {
namespace {

using Active = BoundaryPart::Active;

bool mentions(const Relation& relation, const std::string& name) {
  return relation.lhs.mentions(name) || relation.rhs.mentions(name);
}

TrigonometricSystem without_equations(const Mechanism& mechanism, std::vector<Coordinate> coordinates) {
  TrigonometricSystem system;
  system.name = mechanism.name();
  system.constants = mechanism.constants();
  system.coordinates = std::move(coordinates);
  return system;
}

// The sign of lhs − rhs, where that is a constant over these coordinates, some of which have one value.
std::optional<int> constant_sign(const TrigonometricSystem& system, const Relation& relation) {
  try {
    const Polynomial gap = polynomials(system, {relation.lhs - relation.rhs}).front();
    if (gap.monomials.empty()) return 0;
    return gap.degree() == 0 ? gap.monomials.front().coefficient.sign() : std::nullopt;
  } catch (const ModelError&) {  // sines of lengths
    return std::nullopt;
  }
}

}  // namespace

bool is_no_end(const Constraint& inequality) {
  return inequality.note.starts_with("choice of ") || inequality.note.starts_with("slice of ");
}

std::vector<ReachedInequality> reached_inequalities(const Mechanism& mechanism, const ExpressionMatrix& velocity) {
  std::vector<ReachedInequality> result;
  std::size_t number = 0;
  for (const Constraint& c : mechanism.constraints()) {
    if (c.relation.kind == Relation::Kind::equal) continue;
    ++number;
    const auto is_same = [&](const ReachedInequality& r) { return same_relation(*r.end.inequality, c.relation); };
    if (is_no_end(c) || std::ranges::any_of(result, is_same)) continue;
    const std::vector<Expression> row =
        derivatives(mechanism, velocity.columns, {c.relation.lhs - c.relation.rhs}).front().first;
    bool moves = false, of_outputs = true;
    for (std::size_t j = 0; j < row.size(); ++j) {
      if (same_tree(row[j], 0)) continue;
      moves = moves || !is_fixed(mechanism.coordinates()[mechanism.find_coordinate(velocity.columns[j])]);
      of_outputs = of_outputs && velocity.roles[j] == Role::output;
    }
    if (!moves) continue;
    const std::string own = c.note.empty() ? "inequality " + std::to_string(number) : c.note;
    std::string name = own;
    const auto is_taken = [&](const ReachedInequality& r) { return r.end.name == name; };
    for (int n = 2; std::ranges::any_of(result, is_taken); ++n) name = own + ", " + std::to_string(n);
    result.push_back({{std::move(name), 0, false, c.relation}, of_outputs});
  }
  return result;
}

bool is_settled(const Mechanism& mechanism, const std::vector<Active>& active) {
  const auto is_held = [&](const Coordinate& c) {
    return is_fixed(c) || std::ranges::any_of(active, [&](const Active& a) { return !a.inequality && a.name == c.name; });
  };
  return std::ranges::any_of(active, [&](const Active& a) {
    return a.inequality && std::ranges::all_of(mechanism.coordinates(), [&](const Coordinate& c) {
             return !mentions(*a.inequality, c.name) || is_held(c);
           });
  });
}

bool is_impossible(const Mechanism& mechanism, const std::vector<Active>& active) {
  std::vector<Coordinate> held;
  std::vector<std::string> others;
  for (Coordinate c : mechanism.coordinates()) {
    const auto at = std::ranges::find_if(active, [&](const Active& a) { return !a.inequality && a.name == c.name; });
    if (at != active.end()) c.lower = c.upper = at->value;
    if (is_fixed(c)) {
      held.push_back(c);
    } else {
      others.push_back(c.name);
    }
  }
  const TrigonometricSystem system = without_equations(mechanism, held);
  return std::ranges::any_of(mechanism.constraints(), [&](const Constraint& c) {
    if (c.relation.kind == Relation::Kind::equal) return false;
    if (std::ranges::any_of(others, [&](const std::string& name) { return mentions(c.relation, name); })) return false;
    const std::optional<int> sign = constant_sign(system, c.relation);
    return sign && *sign == (c.relation.kind == Relation::Kind::greater_equal ? -1 : 1);
  });
}

}  // namespace corank::symbolic
