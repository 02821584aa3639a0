#include "corank/symbolic/sets/reached_inequalities.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::symbolic {
namespace {

using Active = BoundaryPart::Active;

bool mentions(const Relation& relation, const std::string& name) {
  return relation.lhs.mentions(name) || relation.rhs.mentions(name);
}

// With those at a limit as ranges of one value.
std::vector<Coordinate> at_limits(const Mechanism& mechanism, const std::vector<Active>& active) {
  std::vector<Coordinate> all = mechanism.coordinates();
  for (const Active& a : active)
    if (!a.inequality) hold(all, a.name, a.value);
  return all;
}

bool is_about_fixed(const Relation& relation, const std::vector<Coordinate>& all) {
  return std::ranges::all_of(all, [&](const Coordinate& c) { return is_fixed(c) || !mentions(relation, c.name); });
}

}  // namespace

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
  const std::vector<Coordinate> all = at_limits(mechanism, active);
  return std::ranges::any_of(active, [&](const Active& a) { return a.inequality && is_about_fixed(*a.inequality, all); });
}

bool is_impossible(const Mechanism& mechanism, const std::vector<Active>& active) {
  const std::vector<Coordinate> all = at_limits(mechanism, active);
  TrigonometricSystem held;
  held.name = mechanism.name();
  held.constants = mechanism.constants();
  std::ranges::copy_if(all, std::back_inserter(held.coordinates), is_fixed);
  return std::ranges::any_of(mechanism.constraints(), [&](const Constraint& c) {
    if (c.relation.kind == Relation::Kind::equal || !is_about_fixed(c.relation, all)) return false;
    try {
      const Polynomial gap = polynomials(held, {c.relation.lhs - c.relation.rhs}).front();
      if (gap.monomials.empty() || gap.degree() > 0) return false;
      return gap.monomials.front().coefficient.sign() == (c.relation.kind == Relation::Kind::greater_equal ? -1 : 1);
    } catch (const ModelError&) {  // sines of lengths
      return false;
    }
  });
}

}  // namespace corank::symbolic
