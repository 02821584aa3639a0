#include "corank/symbolic/velocity/velocity_equation.h"

#include <algorithm>
#include <map>

#include "corank/core/check.h"
#include "corank/symbolic/algebra/ginac_bridge.h"
#include "corank/symbolic/algebra/ginac_lock.h"
#include "corank/symbolic/algebra/remembered.h"

namespace corank::symbolic {
namespace {

bool contains(const auto& list, const auto& item) { return std::ranges::find(list, item) != list.end(); }

bool is_zero(const Expression& e) { return same_tree(e, Expression(0)); }

// lhs − rhs as written.
Expression residual(const Relation& relation) { return is_zero(relation.rhs) ? relation.lhs : relation.lhs - relation.rhs; }

GiNaC::ex difference(const GinacBridge& bridge, const Constraint& constraint) {
  return bridge.to_ginac(constraint.relation.lhs, constraint.where) -
         bridge.to_ginac(constraint.relation.rhs, constraint.where);
}

// Of a term, by a symbol that it has: of a product, the factors with the symbol alone are differentiated.
GiNaC::ex derivative(const GiNaC::ex& term, const GiNaC::symbol& by) {
  if (!GiNaC::is_a<GiNaC::mul>(term)) return term.diff(by);
  GiNaC::exvector sum;
  for (std::size_t i = 0; i < term.nops(); ++i) {
    if (!term.op(i).has(by)) continue;
    GiNaC::exvector product{term.op(i).diff(by)};
    for (std::size_t k = 0; k < term.nops(); ++k)
      if (k != i) product.push_back(term.op(k));
    sum.push_back(GiNaC::mul(product));
  }
  return GiNaC::add(sum);
}

// The terms in which each symbol occurs, so that no derivative looks at the others.
std::map<std::string, GiNaC::exvector> terms_by_symbol(const GinacBridge& bridge, const GiNaC::ex& e) {
  std::map<std::string, GiNaC::exvector> terms;
  for (const GiNaC::ex& term : parts_of<GiNaC::add>(e))
    for (const std::string& name : bridge.names_in(term)) terms[name].push_back(term);
  return terms;
}

constexpr std::size_t kMostEntries = 10'000'000;

void check_size(std::size_t rows, std::size_t columns, const Mechanism& mechanism) {
  if (rows <= kMostEntries / std::max<std::size_t>(columns, 1)) return;
  throw ModelError({mechanism.name(), 0, 0},
                   "its Jacobian has " + std::to_string(rows) + " rows and " + std::to_string(columns) + " columns",
                   "at most " + std::to_string(kMostEntries) + " entries; a plain system is solved without it");
}

// Φ_q, and the coefficients of the rates in a velocity equation, which is linear in them, are derivatives by the columns.
void add_row(const GinacBridge& bridge, const GiNaC::ex& e, const Constraint& constraint, VelocityEquation& velocity) {
  velocity.where.push_back(constraint.where);
  std::vector<Expression>& row = velocity.matrix.rows.emplace_back();
  const std::map<std::string, GiNaC::exvector> terms = terms_by_symbol(bridge, e);
  std::size_t factors = 0;
  for (const auto& [name, list] : terms)
    for (const GiNaC::ex& term : list) factors += term.nops();
  if (factors > kMostEntries / 2)
    throw ModelError(constraint.where, "the derivatives of an equation have " + std::to_string(factors) + " factors",
                     "products of fewer variables; at most " + std::to_string(kMostEntries / 2) + " factors");
  const Expression zero(0);
  for (const std::string& column : velocity.matrix.columns) {
    try {
      const auto with = terms.find(column);
      if (with == terms.end()) {
        row.push_back(zero);
        continue;
      }
      GiNaC::exvector sum;
      for (const GiNaC::ex& term : with->second) sum.push_back(derivative(term, bridge.symbol(column)));
      row.push_back(bridge.to_expression(GiNaC::add(sum)));
    } catch (const std::exception& error) {
      throw ModelError(constraint.where, "the equation `" + constraint.relation.text() + "` cannot be differentiated by " +
                                             column + ": " + error.what());
    }
  }
}

void add_given_rows(const Mechanism& mechanism, VelocityEquation& velocity) {
  std::vector<std::string> names = names_of(mechanism.coordinates());
  for (const Rate& r : mechanism.rates()) {
    velocity.matrix.columns.push_back(r.name);
    velocity.matrix.roles.push_back(r.role);
    names.push_back(r.name);
  }
  velocity.given = true;
  check_size(mechanism.velocity_equations().size(), velocity.matrix.columns.size(), mechanism);
  const GinacBridge bridge(names_of(mechanism.constants()), names);
  for (const Constraint& c : mechanism.velocity_equations()) add_row(bridge, difference(bridge, c), c, velocity);
}

// Do both mechanisms have the same derivation? It knows the constants by their names.
bool derives_alike(const Mechanism& a, const Mechanism& b) {
  const auto same = [](const auto& x, const auto& y, auto&& alike) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(), alike);
  };
  const auto equations = [](const Constraint& x, const Constraint& y) {
    return x.where == y.where && same_relation(x.relation, y.relation);
  };
  return same(a.constants(), b.constants(), [](const Constant& x, const Constant& y) { return x.name == y.name; }) &&
         same(a.coordinates(), b.coordinates(),
              [](const Coordinate& x, const Coordinate& y) { return x.name == y.name && x.kind == y.kind; }) &&
         same(a.rates(), b.rates(), [](const Rate& x, const Rate& y) { return x.name == y.name && x.role == y.role; }) &&
         a.inputs() == b.inputs() && a.outputs() == b.outputs() && same(a.constraints(), b.constraints(), equations) &&
         same(a.velocity_equations(), b.velocity_equations(), equations);
}

Derivation derived(const Mechanism& mechanism) {
  const GinacBridge bridge(mechanism);

  Derivation result{residuals(mechanism), {}};
  VelocityEquation& velocity = result.velocity;
  const bool given = mechanism.has_own_velocity_equation();
  if (given) {
    add_given_rows(mechanism, velocity);
  } else {
    for (const Coordinate& coordinate : mechanism.coordinates()) {
      velocity.matrix.columns.push_back(coordinate.name);
      velocity.matrix.roles.push_back(role_of(mechanism, coordinate.name));
    }
    check_size(mechanism.constraints().size(), velocity.matrix.columns.size(), mechanism);
  }
  for (const Constraint& constraint : mechanism.equations()) {
    const GiNaC::ex phi = difference(bridge, constraint);
    if (!bridge.mentions_coordinate(phi)) {
      const bool number = GiNaC::is_a<GiNaC::numeric>(phi);
      throw ModelError(constraint.where,
                       "the equation `" + constraint.relation.text() + "` " +
                           (!number         ? "is about constants only"
                            : phi.is_zero() ? "always holds"
                                            : "can never hold"),
                       "an equation between coordinates");
    }
    if (!given) add_row(bridge, phi, constraint, velocity);
  }
  return result;
}

Derivatives derivatives_of(const GinacBridge& bridge, const GiNaC::ex& f, const std::vector<std::string>& coordinates) {
  Derivatives d;
  for (std::size_t j = 0; j < coordinates.size(); ++j) {
    const GiNaC::ex first = f.diff(bridge.symbol(coordinates[j]));
    d.first.push_back(bridge.to_expression(first));
    std::vector<Expression>& row = d.second.emplace_back();
    for (std::size_t k = j; k < coordinates.size(); ++k)
      row.push_back(bridge.to_expression(first.diff(bridge.symbol(coordinates[k]))));
  }
  return d;
}

}  // namespace

ExpressionMatrix VelocityEquation::without(std::span<const Role> locked) const {
  ExpressionMatrix result;
  result.rows.resize(matrix.rows.size());
  for (std::size_t j = 0; j < matrix.columns.size(); ++j) {
    if (contains(locked, matrix.roles[j])) continue;
    result.columns.push_back(matrix.columns[j]);
    result.roles.push_back(matrix.roles[j]);
    for (std::size_t i = 0; i < matrix.rows.size(); ++i) result.rows[i].push_back(matrix.rows[i][j]);
  }
  return result;
}

std::vector<std::size_t> VelocityEquation::dependencies(std::span<const Role> locked) const {
  const ExpressionMatrix left = without(locked);
  std::vector<std::size_t> rows;
  if (left.columns.empty() || left.columns.size() == matrix.columns.size()) return rows;
  for (std::size_t i = 0; i < left.rows.size(); ++i)
    if (std::ranges::all_of(left.rows[i], is_zero)) rows.push_back(i);
  return rows;
}

std::vector<std::string> VelocityEquation::names_of(Role role) const {
  std::vector<std::string> names;
  for (std::size_t j = 0; j < matrix.roles.size(); ++j)
    if (matrix.roles[j] == role) names.push_back(matrix.columns[j]);
  return names;
}

Derivation derive(const Mechanism& mechanism) {
  mechanism.validate();
  static Remembered<Mechanism, Derivation> remembered(4);
  return remembered.of(mechanism, derives_alike, derived);
}

long mobility(const Mechanism& mechanism) {
  const std::vector<Coordinate>& all = mechanism.coordinates();
  const auto free = mechanism.has_own_velocity_equation()
                        ? std::ssize(mechanism.rates()) - std::ssize(mechanism.velocity_equations())
                        : std::ssize(all) - std::ssize(mechanism.equations());
  return free - std::ranges::count_if(all, is_fixed);
}

std::vector<Expression> residuals(const Mechanism& mechanism) {
  std::vector<Expression> phi;
  for (const Constraint& equation : mechanism.equations()) phi.push_back(residual(equation.relation));
  return phi;
}

std::vector<Derivatives> derivatives(const Mechanism& mechanism, const std::vector<std::string>& coordinates) {
  const GinacLock lock;
  const GinacBridge bridge(mechanism);
  std::vector<Derivatives> result;
  for (const Constraint& equation : mechanism.equations()) {
    const GiNaC::ex phi = difference(bridge, equation);
    try {
      result.push_back(derivatives_of(bridge, phi, coordinates));
    } catch (const std::exception& error) {
      throw ModelError(equation.where,
                       "the equation `" + equation.relation.text() + "` cannot be differentiated twice: " + error.what());
    }
  }
  return result;
}

std::vector<Derivatives> derivatives(const Mechanism& mechanism, const std::vector<std::string>& coordinates,
                                     const std::vector<Expression>& functions) {
  const GinacLock lock;
  const GinacBridge bridge(mechanism);
  std::vector<Derivatives> result;
  for (const Expression& function : functions)
    result.push_back(derivatives_of(bridge, bridge.to_ginac(function, function.where()), coordinates));
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
