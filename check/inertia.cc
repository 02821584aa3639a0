#include "corank/check/inertia.h"

#include <cmath>
#include <utility>

#include "corank/check/krawczyk.h"
#include "corank/core/box.h"
#include "corank/core/dense.h"

namespace corank::check {
namespace {

using Matrix = std::vector<Sides>;

Eigen::MatrixXd middle(const Matrix& a) {
  Eigen::MatrixXd result(std::ssize(a), a.empty() ? 0 : std::ssize(a.front()));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < a[i].size(); ++j) result(i, j) = a[i][j].mid();
  return result;
}

// Vᵀ·H·V; (i, j) and (j, i) are the same number. Nothing: the enclosures of one number are disjoint.
std::optional<Matrix> congruent(const Matrix& h, const Matrix& v) {
  const std::size_t n = h.size(), k = v.empty() ? 0 : v.front().size();
  Matrix hv(n, Sides(k)), result(k, Sides(k));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < k; ++j)
      for (std::size_t l = 0; l < n; ++l) hv[i][j].add_product(h[i][l], v[l][j]);
  for (std::size_t i = 0; i < k; ++i)
    for (std::size_t j = 0; j < k; ++j)
      for (std::size_t l = 0; l < n; ++l) result[i][j].add_product(v[l][i], hv[l][j]);
  for (std::size_t i = 0; i < k; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (!result[i][j].intersect(result[j][i])) return std::nullopt;
      result[j][i] = result[i][j];
    }
  return result;
}

// Takes multiples of row k from those below, so that nothing of their column k is left.
void eliminate_below(std::size_t k, Matrix& a) {
  for (std::size_t i = k + 1; i < a.size(); ++i) {
    const Enclosure factor = -quotient(a[i][k], a[k][k]);
    for (std::size_t j = k + 1; j < a.size(); ++j) a[i][j].add_product(factor, a[k][j]);
  }
}

}  // namespace

std::optional<Matrix> kernel_basis(const Matrix& a, const std::vector<int>& dependent, const std::vector<int>& free) {
  const std::size_t m = a.size(), n = m + free.size();
  if (dependent.size() != m) return std::nullopt;
  Eigen::MatrixXd y = inverse(middle(a)(Eigen::all, dependent));
  if (!y.allFinite()) return std::nullopt;
  drop_noise(y);
  thread_local Matrix t;  // Y·A, whose memory is used again
  t.resize(m);
  for (std::size_t i = 0; i < m; ++i) {
    t[i].assign(n, Enclosure());
    for (std::size_t b = 0; b < m; ++b)
      for (std::size_t j = 0; y(i, b) != 0 && j < n; ++j)
        if (!a[b][j].is_zero()) t[i][j].add_product(y(i, b), a[b][j]);
  }
  for (std::size_t k = 0; k < m; ++k) {
    const Enclosure pivot = t[k][dependent[k]];
    if (pivot.has_zero() || !pivot.is_bounded()) return std::nullopt;
    for (Enclosure& entry : t[k])
      if (!entry.is_zero()) entry = quotient(entry, pivot);
    for (std::size_t i = 0; i < m; ++i) {
      const Enclosure factor = -t[i][dependent[k]];
      if (i == k || factor.is_zero()) continue;
      for (std::size_t j = 0; j < n; ++j)
        if (!t[k][j].is_zero()) t[i][j].add_product(factor, t[k][j]);
      t[i][dependent[k]] = Enclosure();
    }
  }
  Matrix basis(n, Sides(free.size()));
  for (std::size_t f = 0; f < free.size(); ++f) {
    basis[free[f]][f] = Enclosure(1.0);
    for (std::size_t i = 0; i < m; ++i) basis[dependent[i]][f] = -t[i][free[f]];
  }
  return basis;
}

std::optional<Matrix> form_on_kernel(const Matrix& h, const Matrix& a) {
  const std::vector<int> dependent = pivots(middle(a), a.size()).columns;
  const auto basis = kernel_basis(a, dependent, all_but(dependent, static_cast<int>(h.size())));
  return basis ? congruent(h, *basis) : std::nullopt;
}

std::optional<Matrix> nearly_diagonal(const Matrix& t) {
  const int n = static_cast<int>(t.size());
  const Eigen::MatrixXd vectors = n > 0 ? symmetric_eigen(middle(t)).vectors : Eigen::MatrixXd();
  if (!vectors.allFinite()) return std::nullopt;
  Matrix q(n, Sides(n));
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) q[i][j] = Enclosure(vectors(i, j));
  return congruent(t, q);
}

std::optional<Inertia> inertia(const Matrix& t) {
  std::optional<Matrix> diagonal = nearly_diagonal(t);
  if (!diagonal) return std::nullopt;
  Matrix& d = *diagonal;
  Inertia result;
  for (std::size_t k = 0; k < d.size(); ++k) {
    if (d[k][k].has_zero() || !d[k][k].is_bounded()) return std::nullopt;
    ++(d[k][k].is_positive() ? result.positive : result.negative);
    eliminate_below(k, d);
  }
  return result;
}

std::optional<Inertia> inertia_on_kernel(const Matrix& h, const Matrix& a) {
  const std::optional<Matrix> form = form_on_kernel(h, a);
  return form ? inertia(*form) : std::nullopt;
}

int determinant_sign(std::vector<Sides> a) {
  int sign = 1;
  for (std::size_t k = 0; k < a.size(); ++k) {
    std::size_t row = k, column = k;
    double best = 0;
    for (std::size_t i = k; i < a.size(); ++i)
      for (std::size_t j = k; j < a.size(); ++j)
        if (const double size = a[i][j].mig(); size > best) best = size, row = i, column = j;
    if (!(best > 0 && std::isfinite(best))) return 0;
    if (row != k) sign = -sign;
    if (column != k) sign = -sign;
    std::swap(a[k], a[row]);
    for (Sides& r : a) std::swap(r[k], r[column]);
    if (a[k][k].is_negative()) sign = -sign;
    eliminate_below(k, a);
  }
  return sign;
}

}  // namespace corank::check
