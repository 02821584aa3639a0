#include "corank/certify/requirement.h"

#include <Eigen/LU>
#include <algorithm>
#include <cfloat>
#include <cmath>
#include <map>
#include <optional>

#include "corank/certify/distance.h"
#include "corank/core/check.h"
#include "corank/core/dense.h"
#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

constexpr double kLeastPivot = 1e-9;  // beside the largest: rows below count as dependent

using Offsets = std::span<const Interval>;

AffineForm zero(std::size_t offsets) { return {Interval(), std::vector<Interval>(offsets)}; }

struct Kernel {
  std::vector<std::vector<AffineForm>> basis;  // vectors, each of one component for each column
  bool exact = true;                           // else a larger space
};

double center(const AffineForm& f) { return f.constant.mid(); }

// At least |E|·u, row by row.
std::vector<double> times(const std::vector<double>& e, const std::vector<double>& u) {
  std::vector<double> result;
  for (std::size_t i = 0; i < u.size(); ++i) {
    Interval sum;
    for (std::size_t k = 0; k < u.size(); ++k) sum += Interval(e[i * u.size() + k]) * Interval(u[k]);
    result.push_back(sum.hi());
  }
  return result;
}

// u with t + |E|·u ≤ u, t made positive.
std::optional<std::vector<double>> majorant(const std::vector<double>& e, std::vector<double> t) {
  constexpr int kSteps = 100;
  constexpr double kLeast = 1e-12, kMore = 1.01;
  const double largest = t.empty() ? 0 : *std::ranges::max_element(t);
  for (double& x : t) x = std::max(x, largest > 0 ? std::max(kLeast * largest, DBL_MIN) : 1.0);
  std::vector<double> u = t;
  for (int step = 0; step < kSteps; ++step) {
    std::vector<double> next = times(e, u);
    bool holds = true;
    for (std::size_t i = 0; i < u.size(); ++i) {
      next[i] = (Interval(next[i]) + Interval(t[i])).hi();
      if (!std::isfinite(next[i])) return std::nullopt;
      holds = holds && next[i] <= u[i];
    }
    if (holds) return u;
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = kMore * next[i];
  }
  return std::nullopt;
}

std::optional<Kernel> kernel(const VelocityTest& test, const FormOfVariable& form, Offsets offsets) {
  const int m = test.rows(), n = test.columns;
  std::vector<AffineForm> a;
  Eigen::MatrixXd middle(m, n);
  for (int k = 0; k < m * n; ++k) {
    const MatrixEntry& e = test.matrix[k];
    a.push_back(e.variable >= 0 ? form(e.variable) : AffineForm{e.number.enclose(), std::vector<Interval>(offsets.size())});
    middle(k / n, k % n) = center(a.back());
    if (!std::isfinite(middle(k / n, k % n)) || !a.back().range(offsets).is_bounded()) return std::nullopt;
  }
  Eigen::FullPivLU<Eigen::MatrixXd> lu;
  lu.setThreshold(kLeastPivot);
  std::vector<int> rows, dependent, free;
  int r = 0;
  if (m > 0) {
    lu.compute(middle);
    r = static_cast<int>(lu.rank());
  }
  for (int k = 0; k < r; ++k)
    for (int i = 0; i < m; ++i)
      if (lu.permutationP().indices()(i) == k) rows.push_back(i);
  for (int k = 0; k < n; ++k) (k < r ? dependent : free).push_back(m > 0 ? lu.permutationQ().indices()(k) : k);
  const Eigen::MatrixXd y = Eigen::MatrixXd(middle(rows, dependent)).inverse();
  if (r > 0 && !y.allFinite()) return std::nullopt;

  const auto entry_of_t = [&](int i, int column) {
    AffineForm sum = zero(offsets.size());
    for (int b = 0; b < r; ++b) sum.add(y(i, b), a[rows[b] * n + column]);
    return sum;
  };
  const auto f = static_cast<int>(free.size());
  std::vector<AffineForm> t, e;  // T_F, E
  std::vector<double> size_of_t, size_of_e;
  for (int i = 0; i < r; ++i) {
    for (const int k : free) {
      t.push_back(entry_of_t(i, k));
      size_of_t.push_back(t.back().range(offsets).mag());
    }
    for (int k = 0; k < r; ++k) {
      AffineForm entry = zero(offsets.size());
      entry.add(-1.0, entry_of_t(i, dependent[k]));
      if (i == k) entry.constant += Interval(1.0);
      e.push_back(std::move(entry));
      size_of_e.push_back(e.back().range(offsets).mag());
    }
  }
  Kernel result;
  result.exact = r == m;
  if (f == 0 && r > 0 && !majorant(size_of_e, std::vector<double>(r, 1.0))) return std::nullopt;
  for (int k = 0; k < f; ++k) {
    std::vector<double> sizes(r);
    for (int i = 0; i < r; ++i) sizes[i] = size_of_t[i * f + k];
    const std::optional<std::vector<double>> most = majorant(size_of_e, std::move(sizes));
    if (!most) return std::nullopt;
    const std::vector<double> rest = times(size_of_e, times(size_of_e, *most));
    std::vector<AffineForm> v(n, zero(offsets.size()));
    v[free[k]].constant = Interval(1.0);
    for (int i = 0; i < r; ++i) {
      AffineForm& x = v[dependent[i]];
      x.add(-1.0, t[i * f + k]);
      for (int l = 0; l < r; ++l) x.add(-1.0, product(e[i * r + l], t[l * f + k], offsets));
      x.constant += Interval(-rest[i], rest[i]);
    }
    result.basis.push_back(std::move(v));
  }
  return result;
}

Standing standing_of_form(const VelocityTest& test, const Kernel& kernel, Offsets offsets) {
  const auto k = static_cast<int>(kernel.basis.size());
  if (k == 0) return Standing::satisfied;
  std::vector<AffineForm> q(k * k, zero(offsets.size()));
  Eigen::MatrixXd middle(k, k);
  for (int a = 0; a < k; ++a)
    for (int b = 0; b < k; ++b) {
      for (int j = 0; j < test.columns; ++j)
        if (!test.form[j].is_zero())
          q[a * k + b].add(test.form[j].enclose(), product(kernel.basis[a][j], kernel.basis[b][j], offsets));
      middle(a, b) = center(q[a * k + b]);
    }
  if (!middle.allFinite()) return Standing::open;
  const SymmetricEigen eigen = symmetric_eigen(0.5 * (middle + middle.transpose()));
  Eigen::MatrixXd p = eigen.vectors;
  for (int a = 0; a < k; ++a) p.col(a) /= std::sqrt(std::max(std::fabs(eigen.values(a)), 1e-300));
  if (!p.allFinite()) return Standing::open;
  bool positive = true;
  for (int a = 0; a < k; ++a) {
    Interval others;
    for (int b = 0; b < k; ++b) {
      AffineForm entry = zero(offsets.size());
      for (int i = 0; i < k; ++i)
        for (int j = 0; j < k; ++j) entry.add(Interval(p(i, a)) * Interval(p(j, b)), q[i * k + j]);
      const Interval range = entry.range(offsets);
      if (a == b && range.hi() < 0 && kernel.exact) return Standing::violated;
      if (a == b) {
        others -= range;
      } else {
        others += Interval(range.mag());
      }
    }
    positive = positive && others.hi() < 0;
  }
  return positive ? Standing::satisfied : Standing::open;
}

Standing standing_of_groups(const VelocityTest& test, const Kernel& kernel, Offsets offsets) {
  if (kernel.basis.size() != 1 || !kernel.exact) return Standing::open;
  const std::vector<AffineForm>& v = kernel.basis[0];
  AffineForm gap = zero(offsets.size());  // Σ weight·(e·V), then − bound·Σ s·V_end
  Interval more;                          // what Σ weight·‖V‖ may be beyond Σ weight·(e·V)
  for (const VelocityTest::Group& g : test.groups) {
    const Interval weight = g.weight.enclose();
    double norm = 0;
    for (const int j : g.columns) norm += center(v[j]) * center(v[j]);
    norm = std::sqrt(norm);
    AffineForm along = zero(offsets.size());
    std::vector<double> e;
    for (const int j : g.columns) {
      e.push_back(norm > 0 ? center(v[j]) / norm : 0);
      along.add(e.back(), v[j]);
    }
    Interval length, across;  // ‖e‖², which is 1 but for rounding; ‖V − e(e·V)‖²
    for (std::size_t k = 0; k < g.columns.size(); ++k) {
      length += square(Interval(e[k]));
      AffineForm rest = v[g.columns[k]];
      rest.add(-Interval(e[k]), along);
      across += square(rest.range(offsets));
    }
    const Interval a = along.range(offsets);
    const auto most = square_root(square(Interval(a.lo())) + across);
    if (!most) return Standing::open;
    const double beyond = (Interval(most->hi()) - Interval(a.lo())).hi();
    // With ‖e‖² = 1 + η: ‖V‖² = (1 − η)(e·V)² + ‖V − e(e·V)‖². Without e: all of V is across.
    const double noise = norm > 0 ? ((length - Interval(1.0)) * (Interval(a.mag()) + Interval(beyond))).mag() : 0;
    gap.add(weight, along);
    more += weight * Interval(-noise, (Interval(beyond) + Interval(noise)).hi());
  }
  AffineForm least = gap;  // Σ weight·(e·V) − bound·Σ |V_end|, at least
  for (std::size_t j = v.size() - test.ends; j < v.size(); ++j) {
    const double sign = center(v[j]) < 0 ? -1 : 1;
    const Interval bound = test.bound.enclose(), end = v[j].range(offsets);
    gap.add(-(bound * Interval(sign)), v[j]);  // |V_end| ≥ s·V_end
    if (sign > 0 ? end.lo() >= 0 : end.hi() <= 0)
      least.add(-(bound * Interval(sign)), v[j]);
    else
      least.constant -= bound * Interval(end.mag());
  }
  if (gap.range(offsets).hi() + more.hi() < 0) return Standing::satisfied;
  return (least.range(offsets) + more).lo() > 0 ? Standing::violated : Standing::open;
}

}  // namespace

Standing both(Standing a, Standing b) {
  for (const Standing worst : {Standing::violated, Standing::open})
    if (a == worst || b == worst) return worst;
  return Standing::satisfied;
}

Standing standing(const Requirement& requirement, const FormOfVariable& form, Offsets offsets) {
  CORANK_CHECK(UpwardRounding::active());
  Standing result = Standing::satisfied;
  if (requirement.excess) {
    const Interval range = form(*requirement.excess).range(offsets);
    result = range.hi() <= 0 ? Standing::satisfied : range.lo() > 0 ? Standing::violated : Standing::open;
  }
  for (const DistanceTest& test : requirement.distances)
    if (result != Standing::violated) result = both(result, standing(test, form, offsets));
  for (const VelocityTest& test : requirement.tests) {
    if (result == Standing::violated) break;
    const std::optional<Kernel> space = kernel(test, form, offsets);
    result = both(result, !space              ? Standing::open
                          : test.form.empty() ? standing_of_groups(test, *space, offsets)
                                              : standing_of_form(test, *space, offsets));
  }
  return result;
}

Standing standing(const std::vector<Requirement>& requirements, const FormOfVariable& form, Offsets offsets) {
  std::map<int, AffineForm> known;
  const FormOfVariable once = [&](int variable) {
    const auto found = known.find(variable);
    return found != known.end() ? found->second : known.emplace(variable, form(variable)).first->second;
  };
  Standing result = Standing::satisfied;
  for (const Requirement& r : requirements)
    if (result != Standing::violated) result = both(result, standing(r, once, offsets));
  return result;
}

}  // namespace corank::certify
