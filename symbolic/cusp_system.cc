#include "corank/symbolic/cusp_system.h"

#include "corank/symbolic/kernel_vector.h"
#include "corank/symbolic/locus_by_coordinates.h"

namespace corank::symbolic {
namespace {

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

}  // namespace

TrigonometricSystem cusp_system(const Mechanism& mechanism, SingularitySet set, const std::vector<std::string>& scales) {
  const LocusByCoordinates locus = locus_by_coordinates(mechanism, set, scales);
  const ExpressionMatrix& m = locus.kernel.matrix;
  const SourceLocation where = model_place(mechanism);
  TrigonometricSystem system = plain_system(locus.mechanism);
  system.name += std::string(" ") + locus.kernel.set.name;
  system.kernel_scales = scales;

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
  const std::string name = locus.kernel.name;
  for (std::size_t i = 0; i < m.rows.size(); ++i)
    if (const auto lhs = kernel_row(m.rows[i], rates))
      add(*lhs == Expression(0), "row " + std::to_string(i + 1) + " of " + name + " xi = 0", locus.kernel.where[i]);
  const std::vector<Derivatives> of_phi = derivatives(locus.mechanism, m.columns);
  for (std::size_t i = 0; i < m.rows.size(); ++i) {
    const auto lhs = kernel_row(m.rows[i], accelerations);
    if (!lhs) continue;  // a tie: it holds no coordinate that is not locked
    std::vector<Expression> terms = lhs->kind() == Expression::Kind::sum ? lhs->operands() : std::vector{*lhs};
    for (const Expression& term : second_order(of_phi[i].second, rates)) terms.push_back(factor * term);
    add(sum_of(terms) == Expression(0), "row " + std::to_string(i + 1) + " of " + name + " eta + tau D^2 Phi(xi, xi) = 0",
        locus.kernel.where[i]);
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

}  // namespace corank::symbolic
