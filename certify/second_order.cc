#include "corank/certify/second_order.h"

#include <algorithm>

#include "corank/certify/trigonometric.h"
#include "corank/core/box.h"
#include "corank/core/check.h"
#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

// The derivative of this order, 0, 1 or 2, of a factor.
Interval derivative(const Factor& factor, const Interval& x, int order) {
  const bool odd = order == 1;
  if (factor.function == Function::identity) {
    Interval result(1.0);
    for (int k = 0; k < order; ++k) result *= Interval(static_cast<double>(factor.power - k));
    const int power_left = factor.power - order;
    return power_left < 0 ? Interval(0.0) : power_left == 0 ? result : result * power(x, power_left);
  }
  const bool sine_of_it = factor.function == Function::sine;
  const Interval value = sine_of_it != odd ? sine(x) : cosine(x);
  return order == 2 || (odd && !sine_of_it) ? -value : value;
}

// A monomial with the factor a, and the factor b, differentiated once more each.
Interval term(const Monomial& m, const Box& x, std::size_t a, std::size_t b) {
  Interval result = m.enclosure;
  for (std::size_t k = 0; k < m.factors.size(); ++k)
    result *= derivative(m.factors[k], x[m.factors[k].variable], (k == a) + (k == b));
  return result;
}

}  // namespace

std::vector<Interval> gradient(const Polynomial& f, const Box& x) {
  CORANK_CHECK(UpwardRounding::active());
  std::vector<Interval> result(x.size());
  for (const Monomial& m : f.monomials)
    for (std::size_t a = 0; a < m.factors.size(); ++a) result[m.factors[a].variable] += term(m, x, a, m.factors.size());
  return result;
}

IntervalMatrix hessian(const Polynomial& f, const Box& x) {
  CORANK_CHECK(UpwardRounding::active());
  const int n = static_cast<int>(x.size());
  IntervalMatrix result(n, n);
  for (const Monomial& m : f.monomials)
    for (std::size_t a = 0; a < m.factors.size(); ++a)
      for (std::size_t b = 0; b < m.factors.size(); ++b)
        result(m.factors[a].variable, m.factors[b].variable) += term(m, x, a, b);
  return result;
}

std::optional<std::vector<SheetDerivatives>> sheet_derivatives(const System& system, const std::vector<int>& free,
                                                               const Box& box, const std::vector<Polynomial>& functions) {
  const int m = static_cast<int>(system.equations.size()), n = system.size(), d = static_cast<int>(free.size());
  CORANK_CHECK(m + d == n && std::ranges::is_sorted(free) && UpwardRounding::active());
  const std::vector<int> dependent = all_but(free, n);
  IntervalMatrix jacobian(m, n);
  for (int k = 0; k < m; ++k) {
    const std::vector<Interval> row = gradient(system.equations[k], box);
    for (int j = 0; j < n; ++j) jacobian(k, j) = row[j];
  }
  std::vector<double> sizes, dependent_sizes;
  for (const Variable& v : system.variables) sizes.push_back(v.size);
  for (const int j : dependent) dependent_sizes.push_back(sizes[j]);
  const auto basis = kernel_basis(jacobian, dependent, sizes);
  if (!basis) return std::nullopt;
  // [F_D, V_iᵀ D²F V_j for i ≤ j].
  IntervalMatrix extended(m, m + d * (d + 1) / 2);
  std::vector<int> first_columns;
  for (int k = 0; k < m; ++k) {
    first_columns.push_back(k);
    for (int j = 0; j < m; ++j) extended(k, j) = jacobian(k, dependent[j]);
    const IntervalMatrix bend = congruent(hessian(system.equations[k], box), *basis);
    int column = m;
    for (int i = 0; i < d; ++i)
      for (int j = i; j < d; ++j) extended(k, column++) = bend(i, j);
  }
  const auto bent = kernel_basis(extended, first_columns, dependent_sizes);
  if (!bent) return std::nullopt;
  std::vector<SheetDerivatives> result;
  for (const Polynomial& f : functions) {
    const std::vector<Interval> by = gradient(f, box);
    const IntervalMatrix bend = congruent(hessian(f, box), *basis);
    SheetDerivatives along{std::vector<Interval>(d), IntervalMatrix(d, d)};
    int column = 0;
    for (int i = 0; i < d; ++i) {
      for (int j = 0; j < n; ++j) along.first[i] += by[j] * (*basis)(j, i);
      for (int j = i; j < d; ++j, ++column) {
        Interval second = bend(i, j);
        for (int k = 0; k < m; ++k) second += by[dependent[k]] * (*bent)(k, column);
        along.second(i, j) = along.second(j, i) = second;
      }
    }
    result.push_back(std::move(along));
  }
  return result;
}

}  // namespace corank::certify
