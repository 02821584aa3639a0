#include "corank/solve/step/local_solution.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "corank/core/box.h"
#include "corank/core/dense.h"
#include "corank/core/rounding.h"
#include "corank/solve/step/heuristics.h"

namespace corank::solve {
namespace {

using Vector = Eigen::VectorXd;
template <int Columns>
using OfFree = Eigen::Matrix<double, Eigen::Dynamic, Columns, 0, kMostFreeOfPoints, Columns == 1 ? 1 : kMostFreeOfPoints>;

// The scaled Jacobian, without the parameters' columns, and residual.
void linearize(const Problem& problem, const std::vector<double>& x, Eigen::MatrixXd& a, Vector& b) {
  const certify::CompiledSystem& system = problem.compiled;
  std::vector<double> sparse(system.entries());
  system.approximate_jacobian(x.data(), sparse.data());
  a.setZero(system.equations(), system.variables());
  b.resize(system.equations());
  for (int i = 0; i < system.equations(); ++i) {
    const double size = problem.equation_sizes[i];
    for (int k = system.row_begin(i); k < system.row_begin(i + 1); ++k) {
      const int j = system.column(k);
      a(i, j) = sparse[k] * system.scales()[j] / size;
    }
    b(i) = system.evaluate_at(i, x.data()).mid() / size;
  }
  for (const int j : system.parameters()) a.col(j).setZero();
}

}  // namespace

std::optional<LocalSolution> local_solution(const Problem& problem, std::vector<double> start, double tolerance,
                                            double reach) {
  const certify::CompiledSystem& system = problem.compiled;
  const UpwardRounding rounding;
  LocalSolution result{std::move(start), 0};
  Vector way = Vector::Zero(system.variables());  // in scales
  Eigen::MatrixXd a;
  Vector b;
  for (int step = 0; step < kLocalSteps; ++step) {
    linearize(problem, result.x, a, b);
    if (!a.allFinite() || !b.allFinite()) return std::nullopt;
    // least_squares' tolerance is relative to the largest entry: where all are below it, as where a surface of one equation
    // crosses itself, the rank is 0.
    const bool vanishes = problem.has_surfaces() && a.size() > 0 && a.lpNorm<Eigen::Infinity>() < tolerance;
    const auto [shift, rank] = vanishes ? LeastSquares{Vector::Zero(a.cols()), 0} : least_squares(a, -b, tolerance);
    result.rank = rank;
    const double length = shift.size() > 0 ? shift.lpNorm<Eigen::Infinity>() : 0;
    if (!std::isfinite(length)) return std::nullopt;
    // What a direction without rank leaves of the residual is of second order or, at solutions of higher multiplicity, not
    // much less than the tolerance.
    const double left = b.size() > 0 ? b.lpNorm<Eigen::Infinity>() : 0;
    const bool full = result.rank == std::min(system.equations(), system.unknowns());
    if (length < std::max(kStill, 0.1 * tolerance) &&
        left < (full ? std::max(1e-10, 4 * tolerance * tolerance) : 0.1 * tolerance))
      return result;
    way += shift;
    if (way.lpNorm<Eigen::Infinity>() > reach) return std::nullopt;
    for (int j = 0; j < system.variables(); ++j) result.x[j] += shift(j) * system.scales()[j];
  }
  return std::nullopt;
}

std::optional<Box> box_about_solution(const certify::CompiledSystem& system, const PreconditionerFactory& preconditioners,
                                      std::span<const Interval> x) {
  const certify::Preconditioner& p = preconditioners.last();
  const int r = p.rank();
  const std::vector<int> free = all_but(p.dependent, system.variables());
  const int k = static_cast<int>(free.size());
  if (k > kMostFreeOfPoints) return std::nullopt;
  // Dependents in their sides' halves over the free variables in theirs: value(s) = offset + slope · s.
  Eigen::MatrixXd slope(r, k);
  for (int a = 0; a < r; ++a)
    for (int f = 0; f < k; ++f)
      slope(a, f) = preconditioners.sensitivity(a, free[f]) * x[free[f]].width() / x[p.dependent[a]].width();
  if (!slope.allFinite()) return std::nullopt;
  std::vector<double> at = midpoint(x.first(system.variables()));
  OfFree<1> s = OfFree<1>::Zero(k);
  double outside = 0;  // of half a side
  for (int tries = 0; tries < kPointTries; ++tries) {
    Vector offset(r), values(r);
    for (int a = 0; a < r; ++a) values(a) = system.evaluate_at(p.equations[a], at.data()).mid();
    for (int a = 0; a < r; ++a) {
      double shift = 0;
      for (int b = 0; b < r; ++b) shift += p.y[a * r + b] * values(b);
      const Interval& side = x[p.dependent[a]];
      offset(a) = 2 * (at[p.dependent[a]] - shift - side.mid()) / side.width();
    }
    if (!offset.allFinite()) return std::nullopt;
    offset -= slope * s;
    const double end = 1 - kPointRoom;
    const auto beyond = [&] {
      const Vector value = offset + slope * s;
      return Vector(value - value.cwiseMax(-end).cwiseMin(end));
    };
    // Newton's method for the least Σ beyond², a convex function, quadratic in pieces.
    Vector residual = beyond();
    for (int turn = 0; turn < kPointShifts && residual.squaredNorm() > 0; ++turn) {
      OfFree<Eigen::Dynamic> hessian = 1e-9 * OfFree<Eigen::Dynamic>::Identity(k, k);
      for (int a = 0; a < r; ++a)
        if (residual(a) != 0) hessian += slope.row(a).transpose() * slope.row(a);
      OfFree<1> gradient = slope.transpose() * residual;
      for (int f = 0; f < k; ++f)
        if (std::fabs(s(f)) >= end && gradient(f) * s(f) < 0) {  // it stays at its end
          hessian.row(f).setZero();
          hessian.col(f).setZero();
          hessian(f, f) = 1;
          gradient(f) = 0;
        }
      const OfFree<1> before = s;
      s = (s - hessian.llt().solve(gradient)).cwiseMax(-end).cwiseMin(end);
      residual = beyond();
      if ((s - before).lpNorm<Eigen::Infinity>() < kPointRoom * kPointRoom) break;
    }
    outside = residual.lpNorm<Eigen::Infinity>();
    if (outside > kPointMiss) return std::nullopt;
    double moved = 0;
    const Vector value = offset + slope * s;
    for (int f = 0; f < k; ++f) at[free[f]] = x[free[f]].mid() + s(f) * x[free[f]].width() / 2;
    for (int a = 0; a < r; ++a) {
      const Interval& side = x[p.dependent[a]];
      const double to = side.mid() + value(a) * side.width() / 2;
      moved = std::max(moved, std::fabs(to - at[p.dependent[a]]) / side.width());
      at[p.dependent[a]] = to;
    }
    if (moved < kPointRoom / 8) break;
  }
  if (outside > kPointRoom / 2) return std::nullopt;
  // So small a part of the free sides that the dependents stay in theirs.
  const double share = kPointRoom / 4 / std::max(1.0, slope.cwiseAbs().rowwise().sum().maxCoeff());
  Box box(at.size());
  for (std::size_t j = 0; j < at.size(); ++j) {
    const double half = share * x[j].width();
    box[j] = Interval(at[j] - half, at[j] + half);
  }
  return box;
}

bool breaks_inequality(const Problem& problem, const std::vector<double>& x, double share) {
  const certify::CompiledSystem& system = problem.compiled;
  if (system.inequalities() == 0) return false;
  const UpwardRounding rounding;
  std::vector<Interval> at, slopes(system.entries());
  for (const double v : x) at.emplace_back(v);
  for (int row = system.equations(); row < system.rows(); ++row) {
    double reach = system.evaluate(row, at).mid();
    system.jacobian(row, at, slopes);
    for (int k = system.row_begin(row); k < system.row_begin(row + 1); ++k)
      reach += 2 * share * slopes[k].mag() * system.scales()[system.column(k)];
    if (reach < 0) return true;
  }
  return false;
}

std::vector<double> kernel_basis(const Problem& problem, const LocalSolution& at, double tolerance) {
  const UpwardRounding rounding;
  Eigen::MatrixXd a;
  Vector b;
  linearize(problem, at.x, a, b);
  const SingularValueDecomposition svd = decompose(a);
  const auto n = a.cols();
  int rank = 0;
  for (Eigen::Index k = 0; k < svd.values.size(); ++k) rank += svd.values(k) > tolerance;
  std::vector<double> basis;
  for (Eigen::Index j = 0; j < n; ++j) {
    const bool fixed = std::ranges::binary_search(problem.compiled.parameters(), static_cast<int>(j));
    for (Eigen::Index k = rank; k < n; ++k) basis.push_back(fixed ? 0 : svd.v(j, k));
  }
  return basis;
}

}  // namespace corank::solve
