#include "corank/check/inertia.h"

#include <cmath>
#include <utility>

namespace corank::check {
namespace {

using Matrix = std::vector<Sides>;

// An approximate orthogonal basis of eigenvectors, by Jacobi's rotations in doubles: nothing is proven by it.
std::vector<std::vector<double>> eigenvectors(const Matrix& t) {
  constexpr int kSweeps = 30;
  const std::size_t n = t.size();
  std::vector<std::vector<double>> a(n, std::vector<double>(n)), q(n, std::vector<double>(n, 0.0));
  for (std::size_t i = 0; i < n; ++i) {
    q[i][i] = 1;
    for (std::size_t j = 0; j < n; ++j) a[i][j] = t[i][j].mid();
  }
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        if (!(std::fabs(a[i][j]) > 0)) continue;
        const double angle = 0.5 * std::atan2(2 * a[i][j], a[j][j] - a[i][i]), c = std::cos(angle), s = std::sin(angle);
        const auto turn = [&](double& x, double& y) {
          const double before = x;
          x = c * x - s * y;
          y = s * before + c * y;
        };
        for (std::size_t k = 0; k < n; ++k) turn(a[k][i], a[k][j]);
        for (std::size_t k = 0; k < n; ++k) turn(a[i][k], a[j][k]);
        for (std::size_t k = 0; k < n; ++k) turn(q[k][i], q[k][j]);
      }
  return q;
}

// Vᵀ·H·V; (i, j) and (j, i) are the same number. False: the enclosures of one number are disjoint.
bool congruent(const Matrix& h, const Matrix& v, Matrix& result) {
  const std::size_t n = h.size(), k = v.empty() ? 0 : v.front().size();
  Matrix hv(n, Sides(k));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < k; ++j)
      for (std::size_t l = 0; l < n; ++l) hv[i][j].add_product(h[i][l], v[l][j]);
  result.assign(k, Sides(k));
  for (std::size_t i = 0; i < k; ++i)
    for (std::size_t j = 0; j < k; ++j)
      for (std::size_t l = 0; l < n; ++l) result[i][j].add_product(v[l][i], hv[l][j]);
  for (std::size_t i = 0; i < k; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (!result[i][j].intersect(result[j][i])) return false;
      result[j][i] = result[i][j];
    }
  return true;
}

// The place of the entry that is farthest from 0, from row and column k on; false: each may be 0.
bool pivot(const Matrix& a, std::size_t k, std::size_t& row, std::size_t& column) {
  double best = 0;
  for (std::size_t i = k; i < a.size(); ++i)
    for (std::size_t j = k; j < a[i].size(); ++j)
      if (const double size = a[i][j].mig(); size > best) best = size, row = i, column = j;
  return best > 0 && std::isfinite(best);
}

// A basis of ker A as columns; empty rows where none is shown.
bool kernel(Matrix a, std::size_t n, Matrix& basis) {
  const std::size_t m = a.size();
  if (m > n) return false;
  std::vector<std::size_t> order(n);
  for (std::size_t j = 0; j < n; ++j) order[j] = j;
  for (std::size_t k = 0; k < m; ++k) {
    std::size_t row = k, column = k;
    if (!pivot(a, k, row, column)) return false;
    std::swap(a[k], a[row]);
    for (Sides& r : a) std::swap(r[k], r[column]);
    std::swap(order[k], order[column]);
    const Enclosure own = a[k][k];
    for (std::size_t j = k + 1; j < n; ++j) a[k][j] = quotient(a[k][j], own);
    for (std::size_t i = 0; i < m; ++i) {
      if (i == k) continue;
      const Enclosure factor = -a[i][k];
      for (std::size_t j = k + 1; j < n; ++j) a[i][j].add_product(factor, a[k][j]);
    }
  }
  basis.assign(n, Sides(n - m));
  for (std::size_t f = m; f < n; ++f) {
    basis[order[f]][f - m] = Enclosure(1.0);
    for (std::size_t i = 0; i < m; ++i) basis[order[i]][f - m] = -a[i][f];
  }
  return true;
}

}  // namespace

std::optional<Inertia> inertia_on_kernel(const std::vector<Sides>& h, std::vector<Sides> a) {
  const std::size_t n = h.size();
  Matrix v, t, d;
  if (!kernel(std::move(a), n, v) || !congruent(h, v, t)) return std::nullopt;
  Matrix q;
  for (const std::vector<double>& row : eigenvectors(t)) q.emplace_back(row.begin(), row.end());
  if (!congruent(t, q, d)) return std::nullopt;
  Inertia result;
  for (std::size_t k = 0; k < d.size(); ++k) {
    if (d[k][k].has_zero() || !d[k][k].is_bounded()) return std::nullopt;
    ++(d[k][k].is_positive() ? result.positive : result.negative);
    for (std::size_t i = k + 1; i < d.size(); ++i) {
      const Enclosure factor = -quotient(d[i][k], d[k][k]);
      for (std::size_t j = k + 1; j < d.size(); ++j) d[i][j].add_product(factor, d[k][j]);
    }
  }
  return result;
}

int determinant_sign(std::vector<Sides> a) {
  int sign = 1;
  for (std::size_t k = 0; k < a.size(); ++k) {
    std::size_t row = k, column = k;
    if (!pivot(a, k, row, column)) return 0;
    if (row != k) sign = -sign;
    if (column != k) sign = -sign;
    std::swap(a[k], a[row]);
    for (Sides& r : a) std::swap(r[k], r[column]);
    if (a[k][k].is_negative()) sign = -sign;
    for (std::size_t i = k + 1; i < a.size(); ++i) {
      const Enclosure factor = -quotient(a[i][k], a[k][k]);
      for (std::size_t j = k + 1; j < a.size(); ++j) a[i][j].add_product(factor, a[k][j]);
    }
  }
  return sign;
}

}  // namespace corank::check
