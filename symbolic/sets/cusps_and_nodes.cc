#include "corank/symbolic/sets/cusps_and_nodes.h"

#include <algorithm>
#include <map>

#include "corank/certify/compiled_system.h"
#include "corank/core/rounding.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/velocity/kernel_vector.h"

namespace corank::symbolic {
namespace {

// The locus of which cusps or nodes are asked for, with the derivative of Φ by coordinates as velocity equation: second
// derivatives need coordinates, and a mechanism's own rates have none.
struct LocusByCoordinates {
  Mechanism mechanism;               // without rates of its own
  KernelQuestion kernel;             // right, nothing eliminated; its columns are coordinates
  std::vector<std::string> scales;   // one for each column
  std::string size_per_scale = "1";  // what makes a length's typical size of its scale

  // The plain system, named after the set.
  TrigonometricSystem system(const std::vector<std::string>& given_scales) const {
    TrigonometricSystem result = plain_system(mechanism);
    result.name += std::string(" ") + kernel.set.name;
    result.kernel_scales = given_scales;
    return result;
  }
};

LocusByCoordinates locus_by_coordinates(const Mechanism& mechanism, SingularitySet set,
                                        const std::vector<std::string>& scales) {
  Mechanism plain = mechanism.without_rates();
  const VelocityEquation velocity = derive(plain).velocity;
  KernelQuestion kernel = kernel_question(plain, set, KernelSide::right);
  const std::size_t columns = kernel.matrix.columns.size(), equations = velocity.matrix.rows.size(),
                    rows = equations - velocity.dependencies(kernel.set.locked).size();
  if (rows != columns)
    throw ModelError(model_place(mechanism),
                     kernel.name + " has " + std::to_string(rows) + " rows and " + std::to_string(columns) +
                         " columns, so the locus has no " + (kernel.set.part == LocusPart::cusps ? "cusps" : "nodes"),
                     "a square matrix");
  if (const std::size_t mobility = velocity.matrix.columns.size() - equations; mobility < 2)
    throw ModelError(model_place(mechanism),
                     std::string(kernel.set.name) + " of a mechanism of mobility " + std::to_string(mobility),
                     "a mobility of 2 or more");
  if (!scales.empty() && scales.size() != columns + 1)
    throw ModelError(model_place(mechanism), std::to_string(scales.size()) + " scales", std::to_string(columns + 1));
  LocusByCoordinates result{std::move(plain), std::move(kernel), scales};
  result.scales.resize(columns + 1, "1");
  result.size_per_scale = result.scales.back();
  result.scales.pop_back();
  return result;
}

using Names = std::map<std::string, Expression>;
using Equations = std::vector<TrigonometricSystem::Equation>;

std::string row_name(const LocusByCoordinates& locus, std::size_t i, const std::string& rest) {
  return "row " + std::to_string(i + 1) + " of " + locus.kernel.name + " " + rest;
}

// M ξ = 0, with y′ in place of y where `names` say so.
void add_kernel_rows(TrigonometricSystem& system, const LocusByCoordinates& locus, const std::vector<Expression>& rates,
                     const std::string& vector, const Names& names = {}) {
  const auto& rows = locus.kernel.matrix.rows;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<Expression> row;
    for (const Expression& entry : rows[i]) row.push_back(names.empty() ? entry : entry.substituted(names));
    if (const auto lhs = kernel_row(row, rates))
      system.equations.push_back({*lhs == Expression(0), row_name(locus, i, vector + " = 0"), locus.kernel.where[i], true});
  }
}

// The terms of D²Φ_i(ξ, ξ), of the second derivatives h[j][k − j], j ≤ k.
std::vector<Expression> second_order(const std::vector<std::vector<Expression>>& h, const std::vector<Expression>& xi) {
  std::vector<Expression> terms;
  for (std::size_t j = 0; j < h.size(); ++j)
    for (std::size_t k = j; k < h.size(); ++k) {
      const Expression& entry = h[j][k - j];
      if (same_tree(entry, Expression(0))) continue;
      terms.push_back(j == k ? times(entry, pow(xi[j], 2)) : Expression(2) * times(times(entry, xi[j]), xi[k]));
    }
  return terms;
}

struct Unknowns {
  std::vector<std::string> xi, eta;
  std::string tau;
};

Unknowns unknowns(const Mechanism& mechanism, std::size_t n) {
  Unknowns result{kernel_names(mechanism, n, 1), kernel_names(mechanism, n, 1, "eta"),
                  kernel_names(mechanism, 1, 1, "tau")[0]};
  std::string& tau = result.tau;
  tau.pop_back();  // the 1, where nothing is called tau either
  if (mechanism.has(tau)) tau += "1";
  return result;
}

// Those that are about y, for y′.
void add_second(Equations& list, const Names& names) {
  const std::size_t n = list.size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto in = [&](const auto& name) {
      return list[i].relation.lhs.mentions(name.first) || list[i].relation.rhs.mentions(name.first);
    };
    if (!std::ranges::any_of(names, in)) continue;
    TrigonometricSystem::Equation copy = list[i];
    copy.relation = copy.relation.substituted(names);
    copy.source += ", second configuration";
    list.push_back(std::move(copy));
  }
}

// M ξ = 0, ‖ξ‖ = 1, a·ξ ≥ 0.
void add_kernel(TrigonometricSystem& system, const LocusByCoordinates& locus, const Names& names,
                const std::vector<std::string>& unknowns, const std::string& vector, const SourceLocation& where) {
  add_kernel_rows(system, locus, scaled(unknowns, locus.scales), vector, names);
  const std::vector<Expression> xi = symbols(unknowns);
  system.equations.push_back({square_of(xi) == Expression(1), "norm of " + vector, where, true});
  system.inequalities.push_back({generic_form(xi) >= Expression(0), "half-space of " + vector, where, true});
}

enum class Entry { zero, nonzero, either };

std::vector<std::vector<Entry>> entries_of(const Mechanism& mechanism, const ExpressionMatrix& m) {
  const TrigonometricSystem trigonometric = plain_system(mechanism);
  std::vector<Expression> expressions;
  for (const auto& row : m.rows) expressions.insert(expressions.end(), row.begin(), row.end());
  const System system = algebrize(trigonometric);
  const std::vector<Polynomial> values = polynomials(trigonometric, expressions);
  const certify::CompiledSystem compiled(system, values);
  const UpwardRounding rounding;
  const std::vector<Interval> domain = system.domain();
  std::vector<std::vector<Entry>> result;
  for (std::size_t i = 0, k = 0; i < m.rows.size(); ++i) {
    result.emplace_back();
    for (std::size_t j = 0; j < m.columns.size(); ++j, ++k) {
      const bool zero = values[k].monomials.empty();
      const bool away = !zero && compiled.evaluate(compiled.value_row(static_cast<int>(k)), domain).mig() > 0;
      result.back().push_back(zero ? Entry::zero : away ? Entry::nonzero : Entry::either);
    }
  }
  return result;
}

}  // namespace

TrigonometricSystem cusp_system(const Mechanism& mechanism, SingularitySet set, const std::vector<std::string>& scales) {
  const LocusByCoordinates locus = locus_by_coordinates(mechanism, set, scales);
  const ExpressionMatrix& m = locus.kernel.matrix;
  const SourceLocation where = model_place(mechanism);
  TrigonometricSystem system = locus.system(scales);

  const std::size_t n = m.columns.size();
  const auto [of_xi, of_eta, of_tau] = unknowns(mechanism, n);
  for (const std::string& name : of_xi) system.further_unknowns.push_back({name});
  for (const std::string& name : of_eta) system.further_unknowns.push_back({name});
  system.further_unknowns.push_back({of_tau, 0, 1});

  const std::vector<Expression> xi = symbols(of_xi), eta = symbols(of_eta), rates = scaled(of_xi, locus.scales),
                                accelerations = scaled(of_eta, locus.scales);
  const Expression tau = Expression::symbol(of_tau), factor = scaled({of_tau}, {locus.size_per_scale})[0];
  const auto add = [&](const Relation& relation, const std::string& source, const SourceLocation& place) {
    system.equations.push_back({relation, source, place, true});
  };
  add_kernel_rows(system, locus, rates, "xi");
  const std::vector<Derivatives> of_phi = derivatives(locus.mechanism, m.columns);
  for (std::size_t i = 0; i < m.rows.size(); ++i) {
    const auto lhs = kernel_row(m.rows[i], accelerations);
    if (!lhs) continue;  // a dependency: it holds no coordinate that is not locked
    std::vector<Expression> terms = lhs->kind() == Expression::Kind::sum ? lhs->operands() : std::vector{*lhs};
    for (const Expression& term : second_order(of_phi[i].second, rates)) terms.push_back(factor * term);
    add(sum_of(terms) == Expression(0), row_name(locus, i, "eta + tau D^2 Phi(xi, xi) = 0"), locus.kernel.where[i]);
  }
  std::vector<Expression> eta_and_tau = eta;
  eta_and_tau.push_back(tau);
  add(square_of(xi) == Expression(1), "norm of xi", where);
  add(dot(xi, eta) == Expression(0), "eta orthogonal to xi", where);
  add(square_of(eta_and_tau) == Expression(1), "norm of eta and tau", where);
  system.inequalities.push_back({generic_form(xi) >= Expression(0), "half-space of xi", where, true});
  return system;
}

std::vector<Expression> cusp_sides(const Mechanism& mechanism, SingularitySet set, const std::vector<std::string>& scales,
                                   const std::vector<Expression>& functions) {
  const LocusByCoordinates locus = locus_by_coordinates(mechanism, set, scales);
  const std::vector<std::string>& columns = locus.kernel.matrix.columns;
  const Unknowns names = unknowns(mechanism, columns.size());
  const std::vector<Expression> rates = scaled(names.xi, locus.scales), accelerations = scaled(names.eta, locus.scales);
  const Expression factor = scaled({names.tau}, {locus.size_per_scale})[0];
  std::vector<Expression> result;
  for (const Derivatives& d : derivatives(locus.mechanism, columns, functions)) {
    std::vector<Expression> terms;
    if (const auto first = kernel_row(d.first, accelerations)) terms.push_back(*first);
    for (const Expression& term : second_order(d.second, rates)) terms.push_back(factor * term);
    result.push_back(sum_of(terms));
  }
  return result;
}

std::string second_name(const Mechanism& mechanism, const std::string& coordinate) {
  std::string name = coordinate + "_2";
  while (mechanism.has(name)) name.insert(coordinate.size(), "_");
  return name;
}

TrigonometricSystem node_system(const Mechanism& mechanism, SingularitySet set, const std::vector<std::string>& scales) {
  const LocusByCoordinates locus = locus_by_coordinates(mechanism, set, scales);
  const std::vector<std::string>& columns = locus.kernel.matrix.columns;
  const SourceLocation where = model_place(mechanism);
  TrigonometricSystem system = locus.system(scales);

  Names names;
  const std::size_t n_q = system.coordinates.size();
  for (std::size_t c = 0; c < n_q; ++c) {
    Coordinate copy = system.coordinates[c];
    if (std::ranges::find(columns, copy.name) == columns.end()) continue;
    const std::string second = second_name(mechanism, copy.name);
    names[copy.name] = Expression::symbol(second);
    copy.name = second;
    system.coordinates.push_back(std::move(copy));
  }
  for (Equations* list : {&system.equations, &system.inequalities, &system.claimed}) add_second(*list, names);

  const std::vector<std::string> unknowns = kernel_names(mechanism, columns.size(), 2);
  for (const std::string& name : unknowns) system.further_unknowns.push_back({name});
  const auto half = unknowns.begin() + static_cast<std::ptrdiff_t>(columns.size());
  add_kernel(system, locus, {}, {unknowns.begin(), half}, "xi1", where);
  add_kernel(system, locus, names, {half, unknowns.end()}, "xi2", where);

  std::vector<Expression> difference;
  for (std::size_t c = 0; c < n_q; ++c) {
    const Coordinate& coordinate = system.coordinates[c];
    const auto column = std::ranges::find(columns, coordinate.name);
    if (column == columns.end()) continue;
    const Expression y = Expression::symbol(coordinate.name), other = names.at(coordinate.name);
    if (coordinate.kind == CoordinateKind::angle) {
      difference.insert(difference.end(), {cos(y) - cos(other), sin(y) - sin(other)});
    } else {
      const std::string& scale = locus.scales[column - columns.begin()];
      difference.push_back((y - other) /
                           (positive_number(scale, y.name()) * positive_number(locus.size_per_scale, "a size")));
    }
  }
  system.inequalities.push_back({square_of(difference) >= pow(parse_expression(kNodeDistance, ""), 2),
                                 "distance of the two configurations", where, true});
  system.inequalities.push_back({generic_form(difference) >= Expression(0), "order of the two configurations", where, true});
  return system;
}

bool is_regular_everywhere(const Mechanism& mechanism, SingularitySet set) {
  const Mechanism plain = mechanism.without_rates();
  const ExpressionMatrix m = kernel_question(plain, set, KernelSide::right).matrix;
  std::vector<std::vector<Entry>> rows = entries_of(plain, m);
  std::vector<bool> taken(m.columns.size(), false);
  // A row with one entry left, which is 0 nowhere: it and its column go.
  for (std::size_t left = m.columns.size(); left > 0; --left) {
    const auto sole = [&](const std::vector<Entry>& row) -> std::optional<std::size_t> {
      std::optional<std::size_t> at;
      for (std::size_t j = 0; j < row.size(); ++j) {
        if (taken[j] || row[j] == Entry::zero) continue;
        if (at) return std::nullopt;
        at = j;
      }
      return at && row[*at] == Entry::nonzero ? at : std::nullopt;
    };
    const auto row = std::find_if(rows.begin(), rows.end(), sole);
    if (row == rows.end()) return false;
    taken[*sole(*row)] = true;
    rows.erase(row);
  }
  return true;
}

SingularitySet nodes_of(const Mechanism& mechanism) {
  const bool forward = !is_regular_everywhere(mechanism, SingularitySet::forward_nodes),
             inverse = !is_regular_everywhere(mechanism, SingularitySet::inverse_nodes);
  if (forward != inverse) return forward ? SingularitySet::forward_nodes : SingularitySet::inverse_nodes;
  throw ModelError(
      model_place(mechanism), forward ? "both of its loci may have nodes" : "neither of its loci holds a configuration",
      std::string(to_string(SingularitySet::forward_nodes)) + " or " + to_string(SingularitySet::inverse_nodes));
}

}  // namespace corank::symbolic
