#include "corank/certify/passage.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "corank/certify/projection.h"
#include "corank/core/check.h"
#include "corank/core/dense.h"
#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

std::vector<Polynomial> values_of(const System& system) {
  std::vector<Polynomial> list;
  if (!system.passage) return list;
  const PassageForm& f = *system.passage;
  for (const auto* part : {&f.jacobian, &f.hessian, &f.slack, &f.normal})
    list.insert(list.end(), part->begin(), part->end());
  return list;
}

Eigen::MatrixXd middle(const std::vector<Interval>& form, std::size_t k) {
  const auto n = static_cast<Eigen::Index>(k);
  Eigen::MatrixXd m(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) m(i, j) = form[static_cast<std::size_t>(i * n + j)].mid();
  return m;
}

// Tᵀ S T, T with k rows.
std::vector<Interval> congruent(const std::vector<Interval>& s, std::size_t k, const Eigen::MatrixXd& t) {
  const auto columns = static_cast<std::size_t>(t.cols());
  const auto at = [&](std::size_t i, std::size_t j) {
    return t(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  };
  std::vector<Interval> st(k * columns), result(columns * columns);
  for (std::size_t i = 0; i < k; ++i)
    for (std::size_t j = 0; j < columns; ++j)
      for (std::size_t b = 0; b < k; ++b) st[i * columns + j] += scale(at(b, j), s[i * k + b]);
  for (std::size_t i = 0; i < columns; ++i)
    for (std::size_t j = 0; j < columns; ++j)
      for (std::size_t b = 0; b < k; ++b) result[i * columns + j] += scale(at(b, i), st[b * columns + j]);
  return result;
}

}  // namespace

PassageTest::PassageTest(const System& system)
    : form_(system.coefficient_tolerance > 0 ? std::nullopt : system.passage), compiled_(system, values_of(system)) {
  for (const Polynomial& f : values_of(system))
    for (const Monomial& m : f.monomials)
      for (const Factor& x : m.factors) arguments_.push_back(x.variable);
  std::sort(arguments_.begin(), arguments_.end());
  arguments_.erase(std::unique(arguments_.begin(), arguments_.end()), arguments_.end());
}

Interval PassageTest::value(int index, const Box& box) const { return compiled_.evaluate(compiled_.value_row(index), box); }

// Of the upper triangle, row by row.
int PassageTest::hessian(int j, int k) const {
  if (j > k) std::swap(j, k);
  const int m = form_->columns;
  return form_->equations * m + j * m - j * (j - 1) / 2 + (k - j);
}
int PassageTest::slack(int i) const {
  return form_->equations * form_->columns + static_cast<int>(form_->hessian.size()) + i;
}
int PassageTest::normal(int i) const { return slack(static_cast<int>(form_->slack.size())) + i; }

// Hypothesis (2): which row is passed over, and which columns N has. Any choice is valid where the tests that follow
// succeed.
bool PassageTest::choose(const Box& box, Basis& basis) const {
  const int rows = form_->equations, columns = form_->columns;
  int passed = -1;
  double largest = 0;
  for (int i = 0; i < rows; ++i) {
    const double size = box[static_cast<std::size_t>(form_->multipliers[static_cast<std::size_t>(i)])].mig();
    if (size > largest) largest = size, passed = i;
  }
  if (rows > 0 && (passed < 0 || columns < rows - 1)) return false;  // λ_r ≠ 0
  basis = {};
  for (int i = 0; i < rows; ++i)
    if (i != passed) basis.rows.push_back(i);
  const auto r = static_cast<Eigen::Index>(basis.rows.size());
  Eigen::MatrixXd m(r, columns);
  for (Eigen::Index i = 0; i < r; ++i)
    for (int j = 0; j < columns; ++j) m(i, j) = value(basis.rows[static_cast<std::size_t>(i)] * columns + j, box).mid();
  std::vector<bool> taken(static_cast<std::size_t>(columns), false);
  if (r > 0) {
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(m);
    for (Eigen::Index i = 0; i < r; ++i) {
      basis.dependent.push_back(lu.permutationQ().indices()(i));
      taken[static_cast<std::size_t>(basis.dependent.back())] = true;
    }
  }
  for (int j = 0; j < columns; ++j)
    if (!taken[static_cast<std::size_t>(j)]) basis.others.push_back(j);
  return true;
}

// S over the box; false where N is not shown to be regular. With Y ≈ N⁻¹ and |I − Y·N| of row sums ≤ β < 1, N is regular,
// and x = N⁻¹ b satisfies x = Y·b + (I − Y·N) x, so |x| ≤ |Y·b|/(1 − β) and |x − Y·b|_i ≤ β_i |Y·b|/(1 − β) in the
// maximum norm.
bool PassageTest::reduce(const Box& box, const Basis& basis, std::vector<Interval>& form) const {
  const int columns = form_->columns;
  const std::size_t r = basis.rows.size(), k = basis.others.size();
  const auto entry = [&](std::size_t i, int j) { return value(basis.rows[i] * columns + j, box); };
  std::vector<std::vector<Interval>> w(k, std::vector<Interval>(static_cast<std::size_t>(columns)));
  for (std::size_t a = 0; a < k; ++a) w[a][static_cast<std::size_t>(basis.others[a])] = Interval(1.0);
  if (r > 0) {
    const auto n = static_cast<Eigen::Index>(r);
    Eigen::MatrixXd mid(n, n);
    std::vector<Interval> matrix(r * r);
    for (std::size_t i = 0; i < r; ++i)
      for (std::size_t j = 0; j < r; ++j) {
        matrix[i * r + j] = entry(i, basis.dependent[j]);
        mid(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = matrix[i * r + j].mid();
      }
    const Eigen::MatrixXd y = inverse(mid);  // any real matrix will do
    if (!y.allFinite()) return false;
    const auto y_at = [&](std::size_t i, std::size_t j) {
      return y(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    };
    std::vector<double> excess(r, 0);
    double beta = 0;
    for (std::size_t i = 0; i < r; ++i) {
      for (std::size_t j = 0; j < r; ++j) {
        Interval e(i == j ? 1.0 : 0.0);
        for (std::size_t b = 0; b < r; ++b) e -= scale(y_at(i, b), matrix[b * r + j]);
        excess[i] += e.mag();  // upward
      }
      beta = std::max(beta, excess[i]);
    }
    if (!(beta < 1)) return false;  // N is regular
    for (std::size_t a = 0; a < k; ++a) {
      std::vector<Interval> yb(r);
      double norm = 0;
      for (std::size_t i = 0; i < r; ++i) {
        for (std::size_t b = 0; b < r; ++b) yb[i] -= scale(y_at(i, b), entry(b, basis.others[a]));
        norm = std::max(norm, yb[i].mag());
      }
      const double room = -(beta - 1);   // at most 1 − β: the rounding is upward
      const double bound = norm / room;  // upward
      for (std::size_t i = 0; i < r; ++i) {
        const double radius = excess[i] * bound;  // upward
        if (!std::isfinite(radius)) return false;
        w[a][static_cast<std::size_t>(basis.dependent[i])] = yb[i] + Interval(-radius, radius);
      }
    }
  }
  std::vector<Interval> h(static_cast<std::size_t>(columns * columns));
  for (int i = 0; i < columns; ++i)
    for (int j = i; j < columns; ++j)
      h[static_cast<std::size_t>(i * columns + j)] = h[static_cast<std::size_t>(j * columns + i)] =
          value(hessian(i, j), box);
  form.assign(k * k, Interval());
  for (std::size_t b = 0; b < k; ++b) {
    std::vector<Interval> hw(static_cast<std::size_t>(columns));
    for (std::size_t i = 0; i < hw.size(); ++i)
      for (std::size_t j = 0; j < hw.size(); ++j) hw[i] += h[i * hw.size() + j] * w[b][j];
    for (std::size_t a = 0; a < k; ++a)
      for (std::size_t i = 0; i < hw.size(); ++i) form[a * k + b] += w[a][i] * hw[i];
  }
  return true;
}

// Is sign·S positive definite? Tᵀ S T is so only where S is, and T regular.
bool PassageTest::is_definite(const std::vector<Interval>& form, std::size_t k, int sign) const {
  if (k == 0) return true;
  Eigen::MatrixXd m = sign * middle(form, k);
  m = 0.5 * (m + m.transpose()).eval();
  const Eigen::LLT<Eigen::MatrixXd> factors(m);
  if (factors.info() != Eigen::Success) return false;
  const Eigen::MatrixXd t = inverse(Eigen::MatrixXd(factors.matrixU()));
  if (!t.allFinite()) return false;
  const std::vector<Interval> g = congruent(form, k, t);
  for (std::size_t i = 0; i < k; ++i) {
    const Interval own = sign > 0 ? g[i * k + i] : -g[i * k + i];
    double others = 0;
    for (std::size_t j = 0; j < k; ++j)
      if (j != i) others += std::max(g[i * k + j].mag(), g[j * k + i].mag());
    if (!(own.lo() > others)) return false;
  }
  return true;
}

bool PassageTest::takes_both_signs(const std::vector<Interval>& form, std::size_t k,
                                   const std::vector<Interval>& slack) const {
  bool plus = false, minus = false;
  const auto see = [&](const Interval& x) {
    plus = plus || x.lo() > 0;
    minus = minus || x.hi() < 0;
  };
  for (const Interval& s : slack) see(s);
  if (k > 0) {
    Eigen::MatrixXd m = middle(form, k);
    m = 0.5 * (m + m.transpose()).eval();
    if (!m.allFinite()) return false;
    const SymmetricEigen eigen = symmetric_eigen(m);
    if (!eigen.vectors.allFinite()) return false;
    for (Eigen::Index i = 0; i < m.rows(); ++i) see(congruent(form, k, eigen.vectors.col(i)).front());
  }
  return plus && minus;
}

bool PassageTest::holds(const Claim& claim, const Box& box) const {
  Interval along;  // n·side
  for (std::size_t i = 0; i < claim.side.size(); ++i) along += scale(claim.side[i], value(normal(static_cast<int>(i)), box));
  const bool barrier = claim.passage == Passage::barrier;
  // Hypothesis (1), and of a barrier that −sign·n is on the side named.
  if (along.contains_zero() || (barrier && (claim.sign > 0) != (along.hi() < 0))) return false;
  Basis basis;
  std::vector<Interval> form, slacks;
  if (!choose(box, basis) || !reduce(box, basis, form)) return false;
  for (std::size_t i = 0; i < form_->slack.size(); ++i) slacks.push_back(value(slack(static_cast<int>(i)), box));
  const std::size_t k = basis.others.size();
  if (!barrier) return takes_both_signs(form, k, slacks);
  for (const Interval& s : slacks)
    if (!(claim.sign > 0 ? s.lo() > 0 : s.hi() < 0)) return false;
  return is_definite(form, k, claim.sign);
}

// False: no solution in the box.
bool PassageTest::contract(Box& box) const {
  constexpr int kSweeps = 3;
  std::vector<std::uint8_t> changed(box.size());
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (int row = 0; row < compiled_.rows(); ++row)
      if (!project(compiled_, row, box, 1, changed.data())) return false;
  return true;
}

bool PassageTest::holds(const Claim& claim, Box box, int halvings) const {
  if (holds(claim, box)) return true;
  if (halvings == 0 || arguments_.empty()) return false;
  if (!contract(box) || holds(claim, box)) return true;
  const auto relative_width = [&](std::size_t j) { return box[j].width() / compiled_.scales()[j]; };
  std::size_t widest = static_cast<std::size_t>(arguments_.front());
  for (const int j : arguments_)
    if (relative_width(static_cast<std::size_t>(j)) > relative_width(widest)) widest = static_cast<std::size_t>(j);
  const Interval side = box[widest];
  const double middle = side.mid();
  if (!(side.lo() < middle && middle < side.hi())) return false;
  for (const Interval& half : {Interval(side.lo(), middle), Interval(middle, side.hi())}) {
    box[widest] = half;
    if (!holds(claim, box, halvings - 1)) return false;
  }
  return true;
}

// What the form looks like at the midpoint.
PassageTest::Claim PassageTest::guess(const Box& box) const {
  Box middle_box;
  for (const Interval& side : box) middle_box.emplace_back(side.mid());
  Claim claim{Passage::unproven, 0, {}};
  Basis basis;
  std::vector<Interval> form;
  if (!choose(middle_box, basis) || !reduce(middle_box, basis, form)) return claim;
  int plus = 0, minus = 0;
  const auto count = [&](double x) { ++(x > 0 ? plus : minus); };
  for (std::size_t i = 0; i < form_->slack.size(); ++i) count(value(slack(static_cast<int>(i)), middle_box).mid());
  if (const std::size_t k = basis.others.size(); k > 0) {
    const Eigen::MatrixXd m = middle(form, k);
    if (!m.allFinite()) return claim;
    const Eigen::VectorXd values = symmetric_eigen(0.5 * (m + m.transpose())).values;
    if (!values.allFinite()) return claim;
    for (const double x : values) count(x);
  }
  double size = 0;
  for (std::size_t i = 0; i < form_->normal.size(); ++i) {
    claim.side.push_back(value(normal(static_cast<int>(i)), middle_box).mid());
    size = std::hypot(size, claim.side.back());
  }
  if (!(size > 0) || !std::isfinite(size) || plus + minus == 0) return claim;
  claim.passage = plus > 0 && minus > 0 ? Passage::traversable : Passage::barrier;
  claim.sign = plus > 0 ? 1 : -1;
  // The output stays where n·ü = −Q: at −n for a positive form.
  const double towards = claim.passage == Passage::barrier ? -claim.sign : 1;
  for (double& x : claim.side) x *= towards / size;
  return claim;
}

PassageTest::Finding PassageTest::of(const Box& box, int halvings) const {
  CORANK_CHECK(applies() && UpwardRounding::active());
  const Claim claim = guess(box);
  if (claim.passage == Passage::unproven || !holds(claim, box, halvings)) return {};
  return {claim.passage, claim.side};
}

}  // namespace corank::certify
