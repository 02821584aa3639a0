#include "corank/analyze/paths/path_space.h"

#include <Eigen/QR>
#include <algorithm>

#include "corank/certify/inertia.h"
#include "corank/core/closest_points.h"
#include "corank/core/dense.h"
#include "corank/core/rounding.h"
#include "corank/solve/step/propagation.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/determinant_factors.h"
#include "corank/symbolic/sets/requirements.h"
#include "corank/symbolic/sets/velocity_blocks.h"

namespace corank::analyze {
namespace {

// GiNaC expands their determinants in no time.
bool is_small(const PolynomialMatrix& m) {
  constexpr int kMostColumns = 8;
  constexpr std::size_t kMostTerms = 8;  // of an entry
  return m.columns <= kMostColumns &&
         std::ranges::all_of(m.entries, [](const Polynomial& f) { return f.monomials.size() <= kMostTerms; });
}

bool is_square(const std::vector<int>& rows, const PolynomialMatrix& m) {
  return static_cast<int>(rows.size()) == m.columns;
}

}  // namespace

PathSpace::PathSpace(study::Question question, Avoid avoid, int most_with_factors) : question_(std::move(question)) {
  question_.set = symbolic::SingularitySet::cspace;
  question_.corank = 1;
  equations_ = study::equations(question_);
  system_ = study::system(question_, equations_);
  // A factor is one robot's.
  const bool with_factors = dimension() <= most_with_factors && system_.parameters() == 0;
  using symbolic::SingularitySet;
  if (avoid == Avoid::requirements) {
    distances_ = symbolic::kept_distances(question_.model, equations_);
    bodies_ = std::make_unique<certify::CompiledSystem>(system_, distances_.functions);
    if (distances_.tests.empty() || !symbolic::without_distances(question_.model).requirements().empty())
      add_matrix(SingularitySet::requirements, with_factors);
  } else {
    if (avoid != Avoid::inverse) add_matrix(SingularitySet::forward, with_factors);
    if (avoid != Avoid::forward) add_matrix(SingularitySet::inverse, with_factors);
  }
  std::vector<Polynomial> values;
  for (const PolynomialMatrix& m : matrices_) {
    first_entry_.push_back(static_cast<int>(values.size()));
    values.insert(values.end(), m.entries.begin(), m.entries.end());
  }
  values.insert(values.end(), factors_.begin(), factors_.end());
  compiled_ = std::make_unique<certify::CompiledSystem>(system_, values);
  settle_sizes();
}

// Weights by which each row's and each column's largest entry is 1 in magnitude or less, nearly.
PathSpace::Weights PathSpace::balancing(const Eigen::MatrixXd& magnitudes) {
  constexpr int kTurns = 4;
  Weights w{Eigen::VectorXd::Ones(magnitudes.rows()), Eigen::VectorXd::Ones(magnitudes.cols())};
  const auto inverse_root = [](double x) { return x > 0 && std::isfinite(x) ? 1 / std::sqrt(x) : 1; };
  for (int turn = 0; turn < kTurns && magnitudes.size() > 0; ++turn) {
    const Eigen::MatrixXd a = w.rows.asDiagonal() * magnitudes * w.columns.asDiagonal();
    w.rows.array() *= a.rowwise().maxCoeff().unaryExpr(inverse_root).array();
    w.columns.array() *= a.colwise().maxCoeff().transpose().unaryExpr(inverse_root).array();
  }
  return w;
}

void PathSpace::settle_sizes() {
  equation_sizes_ = solve::typical_sizes(*compiled_, system_.domain()).equations;
  for (const Variable& v : system_.variables) sizes_.push_back(v.size);
  const UpwardRounding rounding;
  const std::vector<Interval> domain = system_.domain();
  for (std::size_t k = 0; k < matrices_.size(); ++k) {
    const PolynomialMatrix& m = matrices_[k];
    Eigen::MatrixXd magnitudes(static_cast<Eigen::Index>(filled_rows_[k].size()), m.columns);
    for (Eigen::Index i = 0; i < magnitudes.rows(); ++i)
      for (int j = 0; j < m.columns; ++j) {
        const int entry = first_entry_[k] + filled_rows_[k][i] * m.columns + j;
        magnitudes(i, j) = compiled_->evaluate(compiled_->value_row(entry), domain).mag();
      }
    weights_.push_back(balancing(magnitudes));
  }
}

std::vector<double> PathSpace::values(const Point& x) const {
  std::vector<double> result(sizes_);
  for (std::size_t j = 0; j < result.size(); ++j) result[j] *= x(static_cast<Eigen::Index>(j));
  return result;
}

PathSpace::Point PathSpace::middle(const Box& box) const {
  Point x(static_cast<Eigen::Index>(box.size()));
  for (std::size_t j = 0; j < box.size(); ++j) x(static_cast<Eigen::Index>(j)) = box[j].mid() / sizes_[j];
  return x;
}

void PathSpace::add_matrix(symbolic::SingularitySet set, bool with_factors) {
  const symbolic::Mechanism model = symbolic::without_distances(question_.model);
  const std::optional<PolynomialMatrix> found = symbolic::locked_polynomials(model, set);
  if (!found)
    throw symbolic::ModelError({question_.model.name(), 0, 0}, "its velocity equation has sines of lengths",
                               "angles in sines and cosines");
  const PolynomialMatrix& m = *found;
  const Avoid of = avoid_from_string(symbolic::to_string(set)).value();
  std::vector<int>& filled = filled_rows_.emplace_back();
  for (int i = 0; i < m.rows; ++i) {
    bool zero = true;
    for (int j = 0; j < m.columns; ++j) zero = zero && m.entries[i * m.columns + j].monomials.empty();
    if (!zero) filled.push_back(i);
  }
  matrices_.push_back(m);
  blocks_.push_back(of);
  ranks_.push_back(std::min(static_cast<int>(filled.size()), m.columns));
  if (!is_square(filled, m) || !with_factors || !is_small(m)) return;
  try {
    const std::vector<symbolic::Expression> factors =
        symbolic::determinant_factors(model, symbolic::locked_matrix(model, set));
    for (Polynomial& f : symbolic::polynomials(equations_, factors)) factors_.push_back(std::move(f));
    for (const symbolic::Expression& f : factors) factor_names_.push_back({of, f.text()});
  } catch (const symbolic::ModelError&) {
    // too large: the determinant's own sign has to do
  }
}

std::size_t PathSpace::sign_functions() const {
  std::size_t count = factors_.size();
  for (std::size_t k = 0; k < matrices_.size(); ++k) count += is_square(filled_rows_[k], matrices_[k]);
  return count;
}

std::vector<PathSpace::SignFunction> PathSpace::sign_names() const {
  std::vector<SignFunction> result;
  for (std::size_t k = 0; k < matrices_.size(); ++k)
    if (is_square(filled_rows_[k], matrices_[k])) result.push_back({blocks_[k], ""});
  result.insert(result.end(), factor_names_.begin(), factor_names_.end());
  return result;
}

std::vector<int> PathSpace::signs(const Box& box) const {
  std::vector<int> result;
  for (std::size_t k = 0; k < matrices_.size(); ++k) {
    const PolynomialMatrix& m = matrices_[k];
    if (!is_square(filled_rows_[k], m)) continue;
    certify::IntervalMatrix a(m.columns, m.columns);
    for (int i = 0; i < m.columns; ++i)
      for (int j = 0; j < m.columns; ++j)
        a(i, j) = compiled_->evaluate(compiled_->value_row(first_entry_[k] + filled_rows_[k][i] * m.columns + j), box);
    result.push_back(certify::determinant_sign(std::move(a)));
  }
  const int factors = static_cast<int>(factors_.size());
  for (int f = compiled_->values() - factors; f < compiled_->values(); ++f)
    result.push_back(sign_of(compiled_->evaluate(compiled_->value_row(f), box)));
  return result;
}

Eigen::VectorXd PathSpace::residual(const Point& x) const {
  const std::vector<double> at = values(x);
  const UpwardRounding rounding;
  Eigen::VectorXd f(compiled_->equations());
  for (int i = 0; i < compiled_->equations(); ++i) f(i) = compiled_->evaluate_at(i, at.data()).mid() / equation_sizes_[i];
  return f;
}

Eigen::MatrixXd PathSpace::jacobian(const Point& x) const {
  std::vector<double> entries(compiled_->entries());
  compiled_->approximate_jacobian(values(x).data(), entries.data());
  Eigen::MatrixXd j = Eigen::MatrixXd::Zero(compiled_->equations(), size());
  for (int i = 0; i < compiled_->equations(); ++i)
    for (int k = compiled_->row_begin(i); k < compiled_->row_begin(i + 1); ++k)
      j(i, compiled_->column(k)) += entries[k] * sizes_[compiled_->column(k)] / equation_sizes_[i];
  for (const int p : compiled_->parameters()) j.col(p).setZero();
  return j;
}

bool PathSpace::project(Point& x, double reach) const {
  constexpr int kSteps = 20;
  constexpr double kSmall = 1e-14, kFast = 0.1;
  const Point from = x;
  double before = 1e300;
  Eigen::MatrixXd inverse;  // of a Jacobian before, as long as its steps shrink fast
  for (int step = 0; step < kSteps; ++step) {
    if (inverse.size() == 0) inverse = pseudo_inverse(jacobian(x));
    const Eigen::VectorXd change = -inverse * residual(x);
    if (!change.allFinite()) return false;
    x += change;
    const double size = change.lpNorm<Eigen::Infinity>();
    if (step > 0 && size > kFast * before) inverse.resize(0, 0);
    if (size < kSmall * (1 + x.lpNorm<Eigen::Infinity>())) break;
    if (step > 3 && size < 1e-11 && size >= before / 2) break;
    if (step + 1 == kSteps) return false;
    before = size;
  }
  return (x - from).lpNorm<Eigen::Infinity>() <= reach;
}

Eigen::MatrixXd PathSpace::tangent(const Point& x) const {
  const std::vector<int>& parameters = compiled_->parameters();  // which keep their values
  Eigen::MatrixXd conditions = Eigen::MatrixXd::Zero(compiled_->equations() + std::ssize(parameters), size());
  conditions.topRows(compiled_->equations()) = jacobian(x);
  for (std::size_t k = 0; k < parameters.size(); ++k) conditions(compiled_->equations() + k, parameters[k]) = 1;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(conditions.transpose());
  const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(size(), size());
  return q.rightCols(dimension());
}

std::vector<double> PathSpace::value_rows(const std::vector<double>& x, int from, int count) const {
  const UpwardRounding rounding;
  std::vector<double> result;
  for (int k = from; k < from + count; ++k)
    result.push_back(compiled_->evaluate_at(compiled_->value_row(k), x.data()).mid());
  return result;
}

double PathSpace::distance_margin(const std::vector<double>& x) const {
  double margin = 1;
  const UpwardRounding rounding;
  const auto value = [&](const MatrixEntry& e) {
    return e.variable < 0 ? e.number.enclose().mid() : bodies_->evaluate_at(bodies_->value_row(e.variable), x.data()).mid();
  };
  for (const DistanceTest& test : distances_.tests) {
    PointsOfBodies hulls;
    for (std::size_t b = 0; b < 2; ++b)
      for (const auto& p : test.hulls[b]) hulls[b].push_back({value(p[0]), value(p[1]), value(p[2])});
    margin = std::min(margin, closest_points(hulls).distance / test.least.enclose().mid() - 1);
  }
  return margin;
}

PathSpace::State PathSpace::state(const Point& x) const {
  State state;
  state.margin = 1;
  const std::vector<double> at = values(x);
  for (std::size_t k = 0; k < matrices_.size(); ++k) {
    const PolynomialMatrix& m = matrices_[k];
    const std::vector<double> entries = value_rows(at, first_entry_[k], m.rows * m.columns);
    Eigen::MatrixXd a(static_cast<Eigen::Index>(filled_rows_[k].size()), m.columns);
    for (Eigen::Index i = 0; i < a.rows(); ++i)
      for (int j = 0; j < m.columns; ++j)
        a(i, j) = entries[filled_rows_[k][i] * m.columns + j] * weights_[k].rows[i] * weights_[k].columns[j];
    if (a.size() == 0) continue;
    const Eigen::VectorXd sigma = singular_values(a);
    state.margin = std::min(state.margin, sigma(0) > 0 ? sigma(sigma.size() - 1) / sigma(0) : 0);
    if (a.rows() == a.cols()) state.signs.push_back(determinant(a) > 0 ? 1 : -1);
  }
  const int factors = static_cast<int>(factors_.size());
  for (const double f : value_rows(at, compiled_->values() - factors, factors)) state.signs.push_back(f > 0 ? 1 : -1);
  const double apart = distance_margin(at);
  state.margin = std::min(state.margin, std::max(apart, 0.0));
  state.inside = apart > 0;
  for (int j = 0; j < size() && state.inside; ++j) {
    const Variable& v = system_.variables[j];
    const double slack = v.kind == VariableKind::length ? 0 : 1e-9, value = at[j];
    if ((!v.lower_implied && value < v.domain.lo() - slack) || (!v.upper_implied && value > v.domain.hi() + slack))
      state.inside = false;
  }
  const UpwardRounding rounding;
  for (int row = compiled_->equations(); row < compiled_->rows() && state.inside; ++row)
    state.inside = compiled_->evaluate_at(row, at.data()).lo() > 0;
  return state;
}

bool PathSpace::admits(const Point& x, const std::vector<int>& signs, double margin) const {
  const State s = state(x);
  return s.inside && s.margin >= margin && s.signs == signs;
}

}  // namespace corank::analyze
