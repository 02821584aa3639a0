#include "corank/symbolic/velocity_equation.h"

#include <algorithm>

#include "corank/core/check.h"
#include "corank/symbolic/ginac_bridge.h"
#include "corank/symbolic/ginac_lock.h"

namespace corank::symbolic {
namespace {

bool contains(const auto& list, const auto& item) { return std::find(list.begin(), list.end(), item) != list.end(); }

bool is_zero(const Expression& e) { return same_tree(e, Expression(0)); }

// lhs − rhs as written.
Expression residual(const Relation& relation) { return is_zero(relation.rhs) ? relation.lhs : relation.lhs - relation.rhs; }

}  // namespace

ExpressionMatrix VelocityEquation::without(std::span<const Role> locked) const {
  ExpressionMatrix result;
  result.rows.resize(matrix.rows.size());
  for (std::size_t j = 0; j < matrix.columns.size(); ++j) {
    if (contains(locked, roles[j])) continue;
    result.columns.push_back(matrix.columns[j]);
    for (std::size_t i = 0; i < matrix.rows.size(); ++i) result.rows[i].push_back(matrix.rows[i][j]);
  }
  return result;
}

std::vector<std::size_t> VelocityEquation::ties(std::span<const Role> locked) const {
  const ExpressionMatrix left = without(locked);
  std::vector<std::size_t> rows;
  if (left.columns.empty() || left.columns.size() == matrix.columns.size()) return rows;
  for (std::size_t i = 0; i < left.rows.size(); ++i)
    if (std::all_of(left.rows[i].begin(), left.rows[i].end(), is_zero)) rows.push_back(i);
  return rows;
}

Derivation derive(const Mechanism& mechanism) {
  mechanism.validate();
  const GinacLock lock;
  std::vector<std::string> coordinates;
  for (const Coordinate& coordinate : mechanism.coordinates()) coordinates.push_back(coordinate.name);
  const GinacBridge bridge(mechanism);

  Derivation result;
  VelocityEquation& velocity = result.velocity;
  velocity.matrix.columns = coordinates;
  for (const std::string& coordinate : coordinates) velocity.roles.push_back(role_of(mechanism, coordinate));
  for (const Constraint& constraint : mechanism.constraints()) {
    if (constraint.relation.kind != Relation::Kind::equal) continue;
    const std::string text = constraint.relation.text();
    const GiNaC::ex phi = bridge.to_ginac(constraint.relation.lhs, constraint.where) -
                          bridge.to_ginac(constraint.relation.rhs, constraint.where);
    if (!bridge.mentions_coordinate(phi)) {
      const bool number = GiNaC::is_a<GiNaC::numeric>(phi);
      throw ModelError(constraint.where,
                       "the equation `" + text + "` " +
                           (!number         ? "is about constants only"
                            : phi.is_zero() ? "holds always"
                                            : "can never hold"),
                       "an equation between coordinates");
    }
    result.phi.push_back(residual(constraint.relation));
    velocity.where.push_back(constraint.where);
    std::vector<Expression>& row = velocity.matrix.rows.emplace_back();
    for (const std::string& coordinate : coordinates) {
      try {
        row.push_back(bridge.to_expression(phi.diff(bridge.symbol(coordinate))));
      } catch (const std::exception& error) {
        throw ModelError(constraint.where,
                         "the equation `" + text + "` cannot be differentiated by " + coordinate + ": " + error.what());
      }
    }
  }
  return result;
}

Role role_of(const Mechanism& mechanism, const std::string& coordinate) {
  return contains(mechanism.inputs(), coordinate)    ? Role::input
         : contains(mechanism.outputs(), coordinate) ? Role::output
                                                     : Role::passive;
}

const std::vector<std::string>& names_of(const Mechanism& mechanism, Role role) {
  CORANK_CHECK(role != Role::passive);
  return role == Role::input ? mechanism.inputs() : mechanism.outputs();
}

}  // namespace corank::symbolic
