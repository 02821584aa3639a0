#include "corank/check/requirement.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <optional>

#include "corank/check/distance.h"
#include "corank/check/inertia.h"
#include "corank/check/krawczyk.h"
#include "corank/core/box.h"
#include "corank/core/dense.h"

namespace corank::check {
namespace {

constexpr double kLeastPivot = 1e-9;

// At least |E|·u.
std::vector<double> pushed(const Eigen::MatrixXd& e, const std::vector<double>& u) {
  std::vector<double> result;
  for (std::size_t i = 0; i < u.size(); ++i) {
    Enclosure sum;
    for (std::size_t k = 0; k < u.size(); ++k) sum.add_product(e(i, k), Enclosure(u[k]));
    result.push_back(sum.hi());
  }
  return result;
}

// u ≥ |t| + |E|·u, and more where t is 0; empty where none is found.
std::vector<double> majorant(const Eigen::MatrixXd& e, std::vector<double> t) {
  constexpr int kSteps = 100;
  double greatest = 0;
  for (const double x : t) greatest = std::max(greatest, x);
  for (double& x : t) x = std::max(x, greatest > 0 ? std::max(1e-12 * greatest, DBL_MIN) : 1.0);
  std::vector<double> u = t;
  for (int step = 0; step < kSteps; ++step) {
    std::vector<double> next = pushed(e, u);
    bool holds = true;
    for (std::size_t i = 0; i < u.size(); ++i) {
      next[i] = (Enclosure(next[i]) + Enclosure(t[i])).hi();
      if (!std::isfinite(next[i])) return {};
      holds = holds && next[i] <= u[i];
    }
    if (holds) return u;
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = 1.02 * next[i];
  }
  return {};
}

class VelocityCheck {
 public:
  VelocityCheck(const VelocityTest& test, const FormOfVariable& form, const Sides& offsets)
      : test_(test), offsets_(offsets), rows_(test.rows()), columns_(test.columns) {
    for (const MatrixEntry& e : test.matrix)
      a_.push_back(e.variable < 0 ? Form{Enclosure(e.number), Sides(offsets.size())} : form(e.variable));
  }

  Standing run() {
    if (!find_kernel()) return Standing::open;
    return test_.form.empty() ? compare_groups() : compare_form();
  }

 private:
  using Vector = std::vector<Form>;

  Form zero() const { return {Enclosure(), Sides(offsets_.size())}; }

  // kernel_ := a basis of the kernel of the pivots' rows.
  bool find_kernel() {
    Eigen::MatrixXd middle(rows_, columns_);
    for (std::size_t i = 0; i < rows_; ++i)
      for (std::size_t j = 0; j < columns_; ++j) {
        const Form& f = a_[i * columns_ + j];
        if (!f.range(offsets_).is_bounded()) return false;
        middle(i, j) = f.constant.mid();
      }
    const Pivots p = pivots(middle, rows_, kLeastPivot * middle.lpNorm<Eigen::Infinity>());
    const std::size_t r = p.rows.size();
    all_rows_ = r == rows_;
    const Eigen::MatrixXd y = inverse(middle(p.rows, p.columns));
    if (!y.allFinite()) return false;
    const std::vector<int> free = all_but(p.columns, static_cast<int>(columns_));
    // Y·A in one column, row i.
    const auto preconditioned = [&](std::size_t i, int j) {
      Form sum = zero();
      for (std::size_t b = 0; b < r; ++b) sum.add_multiple(Enclosure(y(i, b)), a_[p.rows[b] * columns_ + j]);
      return sum;
    };
    std::vector<Vector> e(r), t(r);
    Eigen::MatrixXd e_size = y;  // whose entries are all replaced
    for (std::size_t i = 0; i < r; ++i) {
      for (std::size_t k = 0; k < r; ++k) {
        Form f = zero();
        f.add_multiple(Enclosure(-1.0), preconditioned(i, p.columns[k]));
        if (i == k) f.constant += Enclosure(1.0);
        e_size(i, k) = f.range(offsets_).mag();
        e[i].push_back(std::move(f));
      }
      for (const int j : free) t[i].push_back(preconditioned(i, j));
    }
    if (free.empty() && r > 0 && majorant(e_size, std::vector<double>(r, 1.0)).empty()) return false;
    for (std::size_t k = 0; k < free.size(); ++k) {
      std::vector<double> sizes;
      for (std::size_t i = 0; i < r; ++i) sizes.push_back(t[i][k].range(offsets_).mag());
      const std::vector<double> most = majorant(e_size, std::move(sizes));
      if (most.size() != r) return false;
      const std::vector<double> rests = pushed(e_size, pushed(e_size, most));
      Vector v(columns_, zero());
      v[free[k]].constant = Enclosure(1.0);
      for (std::size_t i = 0; i < r; ++i) {
        Form& x = v[p.columns[i]];
        x.add_multiple(Enclosure(-1.0), t[i][k]);
        for (std::size_t l = 0; l < r; ++l) x.add_multiple(Enclosure(-1.0), product(e[i][l], t[l][k], offsets_));
        x.constant += Enclosure(-rests[i], rests[i]);
        if (!x.range(offsets_).is_bounded()) return false;
      }
      kernel_.push_back(std::move(v));
    }
    return true;
  }

  Standing compare_form() const {
    const auto k = static_cast<int>(kernel_.size());
    if (k == 0) return Standing::satisfied;
    std::vector<Vector> q(k);
    Eigen::MatrixXd middle(k, k);
    for (int a = 0; a < k; ++a)
      for (int b = 0; b < k; ++b) {
        Form sum = zero();
        for (std::size_t j = 0; j < columns_; ++j)
          if (!test_.form[j].is_zero())
            sum.add_multiple(Enclosure(test_.form[j]), product(kernel_[a][j], kernel_[b][j], offsets_));
        middle(a, b) = sum.constant.mid();
        q[a].push_back(std::move(sum));
      }
    const Eigen::MatrixXd p = symmetric_eigen(middle).vectors;
    if (!p.allFinite()) return Standing::open;
    std::vector<Sides> t(k);  // PᵀQP
    for (int a = 0; a < k; ++a)
      for (int b = 0; b < k; ++b) {
        Form sum = zero();
        for (int i = 0; i < k; ++i)
          for (int j = 0; j < k; ++j) sum.add_multiple(Enclosure(p(i, a)) * Enclosure(p(j, b)), q[i][j]);
        t[a].push_back(sum.range(offsets_));
      }
    for (int a = 0; a < k && all_rows_; ++a)
      if (t[a][a].is_negative()) return Standing::violated;
    const std::optional<Inertia> signs = inertia(t);
    return signs && signs->positive == k ? Standing::satisfied : Standing::open;
  }

  Standing compare_groups() const {
    if (kernel_.size() != 1 || !all_rows_) return Standing::open;
    const Vector& v = kernel_[0];
    Form sum = zero();     // Σ weight·(e·V), e a vector for each group
    Enclosure difference;  // of Σ weight·‖V‖ from it
    for (const VelocityTest::Group& g : test_.groups) {
      const Enclosure weight(g.weight);
      std::vector<double> e;
      double norm = 0;
      for (const int j : g.columns) e.push_back(v[j].constant.mid()), norm += e.back() * e.back();
      norm = std::sqrt(norm);
      Form along = zero();
      Enclosure length, across;
      for (std::size_t k = 0; k < e.size(); ++k) {
        e[k] = norm > 0 ? e[k] / norm : 0;
        along.add_multiple(Enclosure(e[k]), v[g.columns[k]]);
        length += power(Enclosure(e[k]), 2);
      }
      for (std::size_t k = 0; k < e.size(); ++k) {
        Form rest = v[g.columns[k]];
        rest.add_multiple(Enclosure(-e[k]), along);
        across += power(rest.range(offsets_), 2);
      }
      const Enclosure a = along.range(offsets_);
      // ‖V‖ − a = √(a² + across) − a falls with a; with ‖e‖² = 1 + η, ‖V‖² = (1 − η)a² + across. Without e, across is all.
      const Enclosure least = a.lower_end(), beyond = (square_root(power(least, 2) + across) - least).upper_end();
      const double noise = norm > 0 ? ((length - Enclosure(1.0)) * (Enclosure(a.mag()) + beyond)).mag() : 0;
      sum.add_multiple(weight, along);
      difference.add_product(weight, Enclosure(-noise, (beyond + Enclosure(noise)).hi()));
    }
    const Enclosure bound(test_.bound);
    Form most = sum, least = sum;  // less bound·Σ |V_end|
    for (std::size_t j = v.size() - test_.ends; j < v.size(); ++j) {
      const Enclosure end = v[j].range(offsets_), sign(v[j].constant.mid() < 0 ? -1.0 : 1.0);
      most.add_multiple(-(bound * sign), v[j]);
      if ((sign * end).is_nonnegative())
        least.add_multiple(-(bound * sign), v[j]);
      else
        least.constant += -(bound * Enclosure(end.mag()));
    }
    if ((most.range(offsets_) + difference).is_negative()) return Standing::satisfied;
    return (least.range(offsets_) + difference).is_positive() ? Standing::violated : Standing::open;
  }

  const VelocityTest& test_;
  const Sides& offsets_;
  const std::size_t rows_, columns_;
  Vector a_;
  std::vector<Vector> kernel_;
  bool all_rows_ = true;  // else kernel_ spans more than ker A
};

}  // namespace

Standing standing(const Requirement& requirement, const FormOfVariable& form, const Sides& offsets) {
  Standing result = Standing::satisfied;
  if (requirement.excess) {
    const Enclosure excess = form(*requirement.excess).range(offsets);
    if (excess.is_positive()) return Standing::violated;
    if (!excess.at_most(Enclosure(0.0))) result = Standing::open;
  }
  const auto add = [&](Standing part) {
    if (result != Standing::violated && part != Standing::satisfied) result = part;
  };
  for (const DistanceTest& test : requirement.distances) add(standing(test, form, offsets));
  for (const VelocityTest& test : requirement.tests)
    if (result != Standing::violated) add(VelocityCheck(test, form, offsets).run());
  return result;
}

}  // namespace corank::check
