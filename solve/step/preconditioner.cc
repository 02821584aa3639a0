#include "corank/solve/step/preconditioner.h"

#include <algorithm>
#include <cmath>

#include "corank/core/box.h"
#include "corank/core/lanes.h"
#include "corank/solve/step/problem.h"
#include "corank/solve/step/recorder.h"

namespace corank::solve {
namespace {

constexpr long kLargeTableau = 20'000;  // entries: a step with it is long enough to ask whether the run has ended

// An m×stride tableau by rows, stride a multiple of kLanes, and what pivots are chosen by.
struct Pivoting {
  double* tableau;
  std::size_t stride;
  int rows;
  const double* allowed;    // weights of the columns, 0 where they may not be taken
  const double* row_scale;  // weights of the rows
  const char* done;         // rows that have had their pivot, or may have none
  double* best;             // of each other row the size of its largest entry
};

// max |row_j|·weight_j over j < stride.
inline double largest(const double* row, const double* weight, std::size_t stride) {
  Lanes best = {};
  for (std::size_t j = 0; j < stride; j += kLanes) {
    const Lanes x = lanes(row + j), size = (x < 0 ? -x : x) * lanes(weight + j);
    best = size > best ? size : best;
  }
  return std::max(std::max(best[0], best[1]), std::max(best[2], best[3]));
}

CORANK_WIDE void find_best(const Pivoting& e) {
  for (int i = 0; i < e.rows; ++i)
    e.best[i] = e.done[i] ? 0 : largest(e.tableau + i * e.stride, e.allowed, e.stride) * e.row_scale[i];
}

// Exchange step: afterwards column `column` holds that of the inverse that belongs to equation `row`.
CORANK_WIDE void exchange(const Pivoting& e, int row, int column) {
  double* const pivot = e.tableau + row * e.stride;
  const double inverse = 1 / pivot[column];
  for (std::size_t j = 0; j < e.stride; j += kLanes) lanes(pivot + j) *= inverse;
  pivot[column] = inverse;
  for (int i = 0; i < e.rows; ++i) {
    double* const t = e.tableau + i * e.stride;
    const double factor = t[column];
    if (i == row || factor == 0) continue;
    t[column] = 0;
    for (std::size_t j = 0; j < e.stride; j += kLanes) lanes(t + j) -= factor * lanes(pivot + j);
    if (!e.done[i]) e.best[i] = largest(t, e.allowed, e.stride) * e.row_scale[i];
  }
}

}  // namespace

PreconditionerFactory::PreconditionerFactory(const certify::CompiledSystem& system, Ended ended)
    : system_(system), ended_(std::move(ended)), m_(system.equations()), n_(system.variables()), stride_(whole_lanes(n_)) {}

const certify::Preconditioner& PreconditionerFactory::at_midpoint(std::span<const Interval> x,
                                                                  const std::vector<int>* candidates,
                                                                  const std::vector<int>* rows) {
  center_.resize(n_);
  for (int j = 0; j < n_; ++j) center_[j] = x[j].mid();
  return at_center(candidates, rows, kRankTolerance);
}

const certify::Preconditioner& PreconditionerFactory::near_solution(std::span<const Interval> x, double rank_tolerance,
                                                                    const std::vector<int>* rows) {
  center_ = midpoint(x.first(n_));
  double former = HUGE_VAL;
  for (int step = 0; step < kGaussNewtonSteps; ++step) {
    at_center(nullptr, rows, rank_tolerance);
    const std::vector<double> start = center_;
    double moved = 0;
    for (int a = 0; a < result_.rank(); ++a) {
      double shift = 0;
      for (int b = 0; b < result_.rank(); ++b)
        shift += result_.y[a * result_.rank() + b] * system_.evaluate_at(result_.equations[b], start.data()).mid();
      center_[result_.dependent[a]] -= shift;
      moved = std::max(moved, std::fabs(shift) / system_.scales()[result_.dependent[a]]);
    }
    if (!(moved < former)) {
      center_ = start;
      break;
    }
    former = moved;
    if (moved < 1e-9) break;
  }
  return at_center(nullptr, rows, rank_tolerance);
}

const certify::Preconditioner& PreconditionerFactory::at_center(const std::vector<int>* candidates,
                                                                const std::vector<int>* rows, double rank_tolerance) {
  sparse_.resize(system_.entries());
  system_.approximate_jacobian(center_.data(), sparse_.data());

  weights_ = system_.scales();
  for (const int j : system_.parameters()) weights_[j] = 0;
  tableau_.assign(m_ * stride_, 0.0);
  row_scale_.assign(m_, 0.0);
  for (int i = 0; i < m_; ++i) {
    for (int k = system_.row_begin(i); k < system_.row_begin(i + 1); ++k) {
      tableau_[i * stride_ + system_.column(k)] = sparse_[k];
      row_scale_[i] = std::max(row_scale_[i], std::fabs(sparse_[k]) * weights_[system_.column(k)]);
    }
    row_scale_[i] = row_scale_[i] > 0 ? 1 / row_scale_[i] : 0;
  }
  row_done_.assign(m_, rows ? 1 : 0);
  if (rows)
    for (int i : *rows) row_done_[i] = 0;
  allowed_.assign(stride_, 0.0);
  if (candidates) {
    for (int j : *candidates) allowed_[j] = weights_[j];
  } else {
    std::ranges::copy(weights_, allowed_.begin());
  }

  best_size_.resize(m_);
  const Pivoting elimination{tableau_.data(),  stride_,          m_, allowed_.data(), row_scale_.data(),
                             row_done_.data(), best_size_.data()};
  find_best(elimination);

  result_.equations.clear();
  result_.dependent.clear();
  const bool large = !candidates && static_cast<long>(m_) * n_ > kLargeTableau;
  for (int step = 0; step < std::min(m_, n_); ++step) {
    over_ = over_ || (large && is_over(ended_));
    if (over_) {
      result_ = {};
      return result_;
    }
    int row = -1;
    double best = candidates ? 0 : rank_tolerance;  // candidates come from a proof: they are independent
    for (int i = 0; i < m_; ++i)
      if (!row_done_[i] && best_size_[i] > best) best = best_size_[i], row = i;
    if (row < 0) break;
    const double* const pivot_row = tableau_.data() + row * stride_;
    int column = -1;
    double largest_entry = 0;
    for (int j = 0; j < n_; ++j)
      if (const double entry = std::fabs(pivot_row[j]) * allowed_[j]; entry > largest_entry)
        largest_entry = entry, column = j;
    row_done_[row] = 1;
    allowed_[column] = 0;
    exchange(elimination, row, column);
    result_.equations.push_back(row);
    result_.dependent.push_back(column);
  }
  const int r = result_.rank();
  result_.y.resize(r * r);
  for (int a = 0; a < r; ++a)
    for (int b = 0; b < r; ++b) result_.y[a * r + b] = tableau_[result_.equations[a] * stride_ + result_.dependent[b]];
  round_to_floats(result_);
  return result_;
}

std::vector<int> PreconditionerFactory::chart_of_last(const std::vector<double>& sizes, double gain) const {
  const auto size = [&](int j) { return sizes[j]; };
  const std::vector<int>& dependent = result_.dependent;
  Chart chart;  // in units of the sizes
  chart.free = all_but(dependent, n_);
  const std::vector<int>& parameters = system_.parameters();
  std::erase_if(chart.free, [&](int j) { return std::ranges::binary_search(parameters, j); });
  const std::size_t k = chart.free.size();
  chart.tangent.assign(n_ * k, 0.0);
  for (std::size_t f = 0; f < k; ++f) {
    const int j = chart.free[f];
    chart.tangent[j * k + f] = 1;
    for (int a = 0; a < result_.rank(); ++a) {
      const int other = dependent[a];
      chart.tangent[other * k + f] = sensitivity(a, j) * size(j) / size(other);
    }
  }
  improve(chart, gain);
  chart.free.insert(chart.free.end(), parameters.begin(), parameters.end());
  return all_but(chart.free, n_);
}

void improve(Chart& chart, double gain) {
  const std::size_t k = chart.free.size();
  std::vector<double>& t = chart.tangent;
  for (int step = 0; step < kMostExchanges; ++step) {
    double best = gain;
    std::size_t at = t.size();
    for (std::size_t i = 0; i < t.size(); ++i)
      if (std::fabs(t[i]) > best) best = std::fabs(t[i]), at = i;
    if (at == t.size()) return;
    const std::size_t row = at / k, f = at % k;
    chart.free[f] = static_cast<int>(row);
    // Column operations that make `row` a unit vector.
    const double pivot = t[at];
    for (std::size_t i = 0; i < t.size(); i += k) t[i + f] /= pivot;
    for (std::size_t g = 0; g < k; ++g) {
      const double factor = t[row * k + g];
      if (g == f || factor == 0) continue;
      for (std::size_t i = 0; i < t.size(); i += k) t[i + g] -= factor * t[i + f];
    }
  }
}

}  // namespace corank::solve
