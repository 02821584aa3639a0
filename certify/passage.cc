#include "corank/certify/passage.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "corank/certify/numeric.h"
#include "corank/certify/polynomial_algebra.h"
#include "corank/certify/projection.h"
#include "corank/core/box.h"
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

// With the variables that its form names besides.
System with_multipliers(System system) {
  for (int i = 0; system.passage && i < system.passage->further_variables(); ++i)
    system.variables.emplace_back("λ" + std::to_string(i + 1), VariableKind::auxiliary, ExactNumber(-1), ExactNumber(1));
  system.passage.reset();
  return system;
}

Eigen::MatrixXd symmetric_middle(const IntervalMatrix& form) {
  const Eigen::MatrixXd m = middle(form);
  return 0.5 * (m + m.transpose());
}

// Is sign·S positive definite? Tᵀ S T is so only where S is, and T regular.
bool is_definite(const IntervalMatrix& form, int sign) {
  if (form.rows == 0) return true;
  const Eigen::LLT<Eigen::MatrixXd> factors(sign * symmetric_middle(form));
  if (factors.info() != Eigen::Success) return false;
  const Eigen::MatrixXd t = inverse(Eigen::MatrixXd(factors.matrixU()));
  if (!t.allFinite()) return false;
  const IntervalMatrix g = congruent(form, exactly(t));
  for (int i = 0; i < g.rows; ++i) {
    const Interval own = sign > 0 ? g(i, i) : -g(i, i);
    double others = 0;
    for (int j = 0; j < g.columns; ++j)
      if (j != i) others += std::max(g(i, j).mag(), g(j, i).mag());
    if (!(own.lo() > others)) return false;
  }
  return true;
}

bool takes_both_signs(const IntervalMatrix& form, const std::vector<Interval>& slack) {
  bool plus = false, minus = false;
  const auto see = [&](const Interval& x) {
    plus = plus || x.lo() > 0;
    minus = minus || x.hi() < 0;
  };
  for (const Interval& s : slack) see(s);
  if (form.rows > 0) {
    const Eigen::MatrixXd m = symmetric_middle(form);
    if (!m.allFinite()) return false;
    const SymmetricEigen eigen = symmetric_eigen(m);
    if (!eigen.vectors.allFinite()) return false;
    const IntervalMatrix values = congruent(form, exactly(eigen.vectors));
    for (int i = 0; i < values.rows; ++i) see(values(i, i));
  }
  return plus && minus;
}

// How λ is enclosed where m is about Φ_z: any choice is valid.
struct MultiplierChoice {
  int passed = 0;               // r, whose λ is the largest where rows have the same size: det N is a multiple of it
  std::vector<int> columns{};   // D
  std::vector<double> sizes{};  // of λ
};

// Nothing where the rows but one are dependent. Requires as many columns as rows, less one.
std::optional<MultiplierChoice> choose_multiplier(Eigen::MatrixXd m) {
  constexpr double kLeastShare = 0.01;
  const auto n = static_cast<int>(m.rows());
  if (!m.allFinite()) return std::nullopt;
  if (n == 1) return MultiplierChoice{0, {}, {1}};
  std::vector<int> rows(n);
  std::vector<double> of_rows;
  for (int i = 0; i < n; ++i) {
    const double size = m.row(i).lpNorm<Eigen::Infinity>();
    of_rows.push_back(size > 0 ? size : 1);
    m.row(i) /= of_rows[i];
  }
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(m);
  MultiplierChoice result;
  for (int i = 0; i < n; ++i) rows[lu.permutationP().indices()(i)] = i;
  for (int i = 0; i + 1 < n; ++i) result.columns.push_back(lu.permutationQ().indices()(i));
  const int last = rows.back();
  rows.pop_back();
  Eigen::VectorXd lambda = Eigen::VectorXd::Ones(n);
  lambda(rows) = -inverse(m(rows, result.columns).transpose()) * m(last, result.columns).transpose();
  if (!lambda.allFinite()) return std::nullopt;
  const double largest = lambda.cwiseAbs().maxCoeff(&result.passed);
  for (int i = 0; i < n; ++i) result.sizes.push_back(std::max(std::fabs(lambda(i)), kLeastShare * largest) / of_rows[i]);
  return result;
}

}  // namespace

PassageTest::PassageTest(const System& system)
    : form_(system.coefficient_tolerance > 0 ? std::nullopt : system.passage),
      compiled_(with_multipliers(system), values_of(system)),
      arguments_(variables_of(values_of(system))) {
  if (!form_ || form_->further_variables() == 0) return;
  finds_multipliers_ = true;
  std::erase_if(arguments_, [&](int j) { return j >= system.size(); });
  for (int i = 0; i < form_->equations; ++i) form_->multipliers.push_back(system.size() + i);
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

IntervalMatrix PassageTest::jacobian(const std::vector<int>& rows, const Box& box) const {
  IntervalMatrix m(static_cast<int>(rows.size()), form_->columns);
  for (int i = 0; i < m.rows; ++i)
    for (int j = 0; j < m.columns; ++j) m(i, j) = value(rows[i] * m.columns + j, box);
  return m;
}

// Of every solution in the box a λ, where the system has none. False: N is not shown to be regular.
bool PassageTest::enclose_multipliers(Box& box) const {
  const int rows = form_->equations;
  if (!finds_multipliers_) return true;
  if (form_->columns < rows - 1) return false;
  std::vector<int> others(rows);
  std::iota(others.begin(), others.end(), 0);
  const IntervalMatrix m = jacobian(others, box);
  const auto choice = choose_multiplier(middle(m));
  if (!choice) return false;
  others.erase(others.begin() + choice->passed);
  IntervalMatrix transposed(rows - 1, rows);
  for (int i = 0; i < rows - 1; ++i)
    for (int j = 0; j < rows; ++j) transposed(i, j) = m(j, choice->columns[i]);
  const auto lambda = kernel_basis(transposed, others, choice->sizes);
  for (int i = 0; lambda && i < rows; ++i) box[form_->multipliers[i]] = (*lambda)(i, 0);
  return lambda.has_value();
}

// Hypothesis (2): which row is passed over, and which columns N has. Any choice is valid where the tests that follow
// succeed.
bool PassageTest::choose(const Box& box, Basis& basis) const {
  const int rows = form_->equations, columns = form_->columns;
  int passed = -1;
  double largest = 0;
  for (int i = 0; i < rows; ++i) {
    const double size = box[form_->multipliers[i]].mig();
    if (size > largest) largest = size, passed = i;
  }
  if (rows > 0 && (passed < 0 || columns < rows - 1)) return false;  // λ_r ≠ 0
  basis = {};
  for (int i = 0; i < rows; ++i)
    if (i != passed) basis.rows.push_back(i);
  const int r = static_cast<int>(basis.rows.size());
  if (r > 0) {
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(middle(jacobian(basis.rows, box)));
    for (int i = 0; i < r; ++i) basis.dependent.push_back(lu.permutationQ().indices()(i));
  }
  return true;
}

// S over the box; nothing where N is not shown to be regular.
std::optional<IntervalMatrix> PassageTest::reduce(const Box& box, const Basis& basis) const {
  const int columns = form_->columns;
  IntervalMatrix h(columns, columns);
  const auto w = kernel_basis(jacobian(basis.rows, box), basis.dependent);
  if (!w) return std::nullopt;
  for (int i = 0; i < columns; ++i)
    for (int j = i; j < columns; ++j) h(i, j) = h(j, i) = value(hessian(i, j), box);
  return congruent(h, *w);
}

Interval PassageTest::along_normal(const std::vector<double>& side, const Box& box) const {
  Interval sum;
  for (std::size_t i = 0; i < side.size(); ++i) sum += scale(side[i], value(normal(static_cast<int>(i)), box));
  return sum;
}

bool PassageTest::holds(const Claim& claim, const Box& sides) const {
  Box box = sides;
  if (!enclose_multipliers(box)) return false;
  const bool barrier = claim.passage == Passage::barrier;
  if (barrier && !form_->has_slacks) return false;
  if (!form_->normal.empty()) {  // else ‖n‖ = ‖λ‖ ≠ 0, and the barrier names no side
    const Interval along = along_normal(claim.side, box);
    // Hypothesis (1), and of a barrier that −sign·n is on the side named.
    if (along.contains_zero() || (barrier && (claim.sign > 0) != (along.hi() < 0))) return false;
  }
  Basis basis;
  if (!choose(box, basis)) return false;
  const std::optional<IntervalMatrix> form = reduce(box, basis);
  if (!form) return false;
  std::vector<Interval> slacks;
  for (std::size_t i = 0; i < form_->slack.size(); ++i) slacks.push_back(value(slack(static_cast<int>(i)), box));
  if (!barrier) return takes_both_signs(*form, slacks);
  for (const Interval& s : slacks)
    if (!(claim.sign > 0 ? s.lo() > 0 : s.hi() < 0)) return false;
  return is_definite(*form, claim.sign);
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
  const auto halves = halved(box, arguments_, compiled_.scales());
  return halves && std::ranges::all_of(*halves, [&](const Box& half) { return holds(claim, half, halvings - 1); });
}

// What the form looks like at the midpoint, and a side for all of the box.
PassageTest::Claim PassageTest::guess(const Box& box) const {
  const std::vector<double> middle_point = midpoint(box);
  Box middle_box(middle_point.begin(), middle_point.end());
  Claim claim{Passage::unproven, 0, {}};
  if (!enclose_multipliers(middle_box)) return claim;
  Basis basis;
  if (!choose(middle_box, basis)) return claim;
  const std::optional<IntervalMatrix> form = reduce(middle_box, basis);
  if (!form) return claim;
  constexpr double kNoise = 1e-10;
  int plus = 0, minus = 0;
  bool zero = false;
  const auto count = [&](double x) { ++(x > 0 ? plus : minus); };
  for (std::size_t i = 0; i < form_->slack.size(); ++i) count(value(slack(static_cast<int>(i)), middle_box).mid());
  if (form->rows > 0) {
    const Eigen::MatrixXd m = symmetric_middle(*form);
    if (!m.allFinite()) return claim;
    const Eigen::VectorXd values = symmetric_eigen(m).values;
    if (!values.allFinite()) return claim;
    // Motions that leave the output where it is, as a wrist's, have 0.
    double largest = 0;
    for (std::size_t i = 0; i < form_->hessian.size(); ++i)
      largest = std::max(largest, value(hessian(0, 0) + static_cast<int>(i), middle_box).mag());
    for (const double x : values) {
      if (std::fabs(x) > kNoise * largest)
        count(x);
      else
        zero = true;
    }
  }
  if (zero && (plus == 0 || minus == 0)) return claim;
  for (int i = 0; i < static_cast<int>(form_->normal.size()); ++i) claim.side.push_back(value(normal(i), middle_box).mid());
  // Outputs of unlike units: the one whose numbers are largest may steer the normal, and have no sign over the box.
  if (Box whole = box; enclose_multipliers(whole) && along_normal(claim.side, whole).contains_zero())
    for (std::size_t i = 0; i < claim.side.size(); ++i)
      if (value(normal(static_cast<int>(i)), whole).contains_zero()) claim.side[i] = 0;
  double size = 0;
  for (const double x : claim.side) size = std::hypot(size, x);
  if (plus + minus == 0 || (!form_->normal.empty() && (!(size > 0) || !std::isfinite(size)))) return claim;
  claim.passage = plus > 0 && minus > 0 ? Passage::traversable : Passage::barrier;
  claim.sign = plus > 0 ? 1 : -1;
  // The output stays where n·ü = −Q: at −n for a positive form.
  const double towards = claim.passage == Passage::barrier ? -claim.sign : 1;
  for (double& x : claim.side) x *= towards / size;
  return claim;
}

PassageTest::Finding PassageTest::of(const Box& box, int halvings) const {
  CORANK_CHECK(applies() && UpwardRounding::active());
  Box sides = box;
  sides.resize(compiled_.variables());
  const Claim claim = guess(sides);
  if (claim.passage == Passage::unproven || !holds(claim, sides, halvings)) return {};
  return {claim.passage, claim.side};
}

}  // namespace corank::certify
