#include "corank/solve/step/propagation.h"

#include <algorithm>
#include <cmath>

#include "corank/certify/projection.h"
#include "corank/core/rounding.h"

namespace corank::solve {
bool Propagator::run(const certify::CompiledSystem& system, std::span<Interval> x, Recorder* recorder) {
  changed_.resize(system.variables());
  // Rows wait in order; a row comes back when one of its variables has shrunk noticeably. Bounded by a share of the rows,
  // since each return costs a variable a share of its width.
  queue_.clear();
  for (int row = 0; row < system.contracting_rows(); ++row) queue_.push_back(row);
  pending_.assign(system.contracting_rows(), 1);
  const std::size_t limit = system.contracting_rows() * kTurns;
  for (std::size_t head = 0; head < queue_.size() && head < limit; ++head) {
    const int row = queue_[head];
    pending_[row] = 0;
    std::ranges::fill(changed_, 0);
    if (recorder) before_.assign(x.begin(), x.begin() + system.variables());
    const bool empty = !certify::project(system, row, x, worthwhile_, changed_.data());
    if (recorder && (empty || !std::equal(before_.begin(), before_.end(), x.begin())))
      recorder->row(row < system.rows() ? row : system.rows() - row - 1);
    if (empty) return false;
    for (int k = system.row_begin(row); k < system.row_begin(row + 1); ++k) {
      if (!changed_[system.column(k)]) continue;
      for (int other : system.rows_of(system.column(k)))
        if (other != row && !pending_[other]) {
          pending_[other] = 1;
          queue_.push_back(other);
        }
    }
  }
  return true;
}

TypicalSizes typical_sizes(const certify::CompiledSystem& system, std::vector<Interval> domain) {
  const UpwardRounding rounding;
  const auto usable = [](double size) { return size > 0 && std::isfinite(size) ? size : 1; };
  const std::vector<Interval> declared = domain;
  Propagator propagator;
  for (int run = 0; run < kDomainRuns; ++run) {
    const std::vector<Interval> before = domain;
    if (!propagator.run(system, domain)) {  // there is nothing to search
      domain = before;
      break;
    }
    bool gained = false;
    for (std::size_t j = 0; j < domain.size(); ++j)
      gained = gained || domain[j].width() < (1 - Heuristics{}.worthwhile) * before[j].width();
    if (!gained) break;
  }
  TypicalSizes sizes;
  constexpr double kOneValue = 1e-12;  // of a size: a narrower side is one value, enclosed
  for (std::size_t j = 0; j < domain.size(); ++j) {
    const Interval& side = domain[j];
    const double half = 0.5 * side.width(), whole = declared[j].mag();
    // A value at 0 has no size of its own: what is left of it is rounding.
    const double value = side.mag() > kOneValue * whole || !std::isfinite(whole) ? side.mag() : whole;
    sizes.variables.push_back(usable(half > kOneValue * value ? half : value));
  }
  std::vector<Interval> jacobian(system.entries());
  system.jacobian(domain, jacobian);
  for (int row = 0; row < system.equations(); ++row) {
    double largest = 0;
    for (int k = system.row_begin(row); k < system.row_begin(row + 1); ++k)
      largest = std::max(largest, jacobian[k].mag() * sizes.variables[system.column(k)]);
    sizes.equations.push_back(usable(largest));
  }
  for (const int j : system.parameters()) sizes.variables[j] = kParameterSize;
  return sizes;
}

bool Contractor::run(std::span<Interval> x, Statistics& statistics) {
  worth_proving_ = near_sheet_ = regular_ = noisy_ = false;
  if (!propagator_.run(system_, x, recorder_)) return false;
  system_.free_parameters(x);
  const int n = system_.variables();
  widths_.resize(n);
  for (int repeat = 0; repeat < heuristics_.repeats; ++repeat) {
    for (int j = 0; j < n; ++j) widths_[j] = x[j].width();
    const auto& p = preconditioners_.at_midpoint(x);
    if (recorder_) recorder_->newton(p, x);
    const certify::NewtonStep& step = step_.emplace(system_, p, x, workspace_);
    const certify::NewtonOutcome& newton = step.outcome();
    ++statistics.newton_steps;
    if (newton.empty || !step.contract_free(x)) return false;
    system_.free_parameters(x);
    regular_ = newton.regular && p.rank() == system_.equations();
    noisy_ = is_noisy(x);
    worth_proving_ = regular_ && newton.spread < heuristics_.proof_spread;
    near_sheet_ = regular_ && newton.spread < heuristics_.sheet_spread;
    bool gained = false;
    for (int j = 0; j < n && !gained; ++j) gained = x[j].width() < (1 - heuristics_.gain) * widths_[j];
    if (!gained) return true;
    if (!propagator_.run(system_, x, recorder_)) return false;
    system_.free_parameters(x);
  }
  return true;
}

// Does rounding make what the equations say at a point as uncertain as the box is wide? Of a side that is far narrower than
// others this says nothing: dividing those helps.
bool Contractor::is_noisy(std::span<const Interval> x) const {
  const auto relative_width = [&](std::size_t j) { return x[j].width() / system_.scales()[j]; };
  double widest = 0;
  for (std::size_t j = 0; j < x.size(); ++j) widest = std::max(widest, relative_width(j));
  for (std::size_t a = 0; a < step_->dependent().size(); ++a) {
    const std::size_t j = step_->dependent()[a];
    if (relative_width(j) < kNarrow * widest) continue;
    const double noise = step_->noise(static_cast<int>(a)), width = x[j].width();
    if (noise > 0 && noise > (regular_ ? kRegularNoise : kNoise) * width) return true;
  }
  return false;
}

}  // namespace corank::solve
