// Chooses dependent variables and the matrix Y for interval Newton, from an approximate Jacobian. Heuristic:
// certify/newton.h is valid for any choice.
#pragma once

#include <span>
#include <vector>

#include "corank/certify/newton.h"
#include "corank/core/ended.h"
#include "corank/solve/step/heuristics.h"

namespace corank::solve {

class PreconditionerFactory {
 public:
  /// Large eliminations are given up once `ended` is true.
  explicit PreconditionerFactory(const certify::CompiledSystem& system, Ended ended = {});

  /// Gauss–Jordan elimination with complete pivoting of the m×n Jacobian at the midpoint of x, its columns times the
  /// variables' scales: each pivot makes one variable dependent. Fewer than m rows where the Jacobian is numerically rank
  /// deficient. If given, only the `candidates` may become dependent, and only the `rows` are used. Parameters never do.
  const certify::Preconditioner& at_midpoint(std::span<const Interval> x, const std::vector<int>* candidates = nullptr,
                                             const std::vector<int>* rows = nullptr);
  /// The same at a point near the midpoint where all equations nearly hold (a few Gauss–Newton steps), so that the rank of
  /// an over-determined system shows: away from its solutions redundant equations look independent. Pivots below
  /// `rank_tolerance` count as zero. If given, only the `rows` are used.
  const certify::Preconditioner& near_solution(std::span<const Interval> x, double rank_tolerance,
                                               const std::vector<int>* rows = nullptr);

  /// An elimination was given up: its result has no rows, which is valid, too.
  bool over() const { return over_; }
  /// The result of the last call of either.
  const certify::Preconditioner& last() const { return result_; }
  /// The dependent variables to choose instead, sorted: those of the Chart of largest volume in units
  /// of `sizes`.
  std::vector<int> chart_of_last(const std::vector<double>& sizes, double gain) const;
  /// After either: ∂(dependent a)/∂(free j) of the linearized system, r×n row-major, 0 for dependent columns.
  double sensitivity(int a, int j) const { return a >= result_.rank() ? 0 : -tableau_[result_.equations[a] * stride_ + j]; }

 private:
  const certify::Preconditioner& at_center(const std::vector<int>* candidates, const std::vector<int>* rows,
                                           double rank_tolerance);

  const certify::CompiledSystem& system_;
  const Ended ended_;
  bool over_ = false;
  int m_, n_;
  std::size_t stride_;  // of a row of the tableau, whose entries behind column n are 0
  std::vector<double> center_, sparse_, tableau_, weights_, row_scale_, best_size_, allowed_;
  std::vector<char> row_done_;
  certify::Preconditioner result_;
};

/// Which variables to leave free in a proof, so that the proven sheet is covered by few boxes.
///
/// The tangent space of the set at a point is spanned by the k columns of an n×k matrix T: row a holds ∂(variable a)/∂(free
/// f), a unit vector where a is free. Exchanging the free f for a dependent a multiplies the volume of a piece, as measured
/// in the free variables, by |T_af|: the chart in which that volume is largest has |T_af| ≤ 1 throughout, so that a box with
/// free sides w has no side beyond Σ w_f.
struct Chart {
  std::vector<double> tangent;  ///< n×k, row-major
  std::vector<int> free;        ///< k row indices
};

/// Exchanges free variables for others until no exchange multiplies the volume by more than `gain`. Source: maximal-volume
/// submatrices, key Goreinov2010.
void improve(Chart& chart, double gain = kChartGain);

}  // namespace corank::solve
