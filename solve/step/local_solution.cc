#include "corank/solve/step/local_solution.h"

#include <Eigen/Core>
#include <algorithm>

#include "corank/core/dense.h"
#include "corank/core/rounding.h"
#include "corank/solve/step/heuristics.h"

namespace corank::solve {
namespace {

using Vector = Eigen::VectorXd;

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
