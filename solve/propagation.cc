#include "corank/solve/propagation.h"

#include <algorithm>
#include <cmath>

#include "corank/certify/projection.h"
#include "corank/core/rounding.h"

namespace corank::solve {
namespace {

constexpr double kWorthwhileShare = 0.1;  // a projection that gains less is not followed up; measured, see bench/HISTORY.md
constexpr std::size_t kTurns = 8;         // of all rows, at most
constexpr int kDomainRuns = 8;            // of the search domain

}  // namespace

bool Propagator::run(const certify::CompiledSystem& system, std::span<Interval> x, Recorder* recorder) {
  changed_.resize(system.variables());
  // Rows wait in order; a row comes back when one of its variables has shrunk noticeably. Bounded by a share of the rows,
  // since each return costs a variable a tenth of its width.
  queue_.clear();
  for (int row = 0; row < system.contracting_rows(); ++row) queue_.push_back(row);
  pending_.assign(system.contracting_rows(), 1);
  const std::size_t limit = system.contracting_rows() * kTurns;
  for (std::size_t head = 0; head < queue_.size() && head < limit; ++head) {
    const int row = queue_[head];
    pending_[row] = 0;
    std::fill(changed_.begin(), changed_.end(), 0);
    if (recorder) before_.assign(x.begin(), x.begin() + system.variables());
    const bool empty = !certify::project(system, row, x, kWorthwhileShare, changed_.data());
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
      gained = gained || domain[j].width() < (1 - kWorthwhileShare) * before[j].width();
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
  return sizes;
}

}  // namespace corank::solve
