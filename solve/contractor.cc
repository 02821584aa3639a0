#include "corank/solve/contractor.h"

#include <algorithm>

namespace corank::solve {
namespace {

constexpr double kNoise = 0.5, kRegularNoise = 8;  // of a side: what rounding alone makes as wide is divided in vain
constexpr double kNarrow = 1e-3;                   // of the widest side

}  // namespace

bool Contractor::run(std::span<Interval> x, Statistics& statistics) {
  worth_proving_ = near_sheet_ = regular_ = noisy_ = false;
  if (!propagator_.run(system_, x, recorder_)) return false;
  const int n = system_.variables();
  widths_.resize(static_cast<std::size_t>(n));
  for (int repeat = 0; repeat < tuning_.repeats; ++repeat) {
    for (int j = 0; j < n; ++j) widths_[j] = x[j].width();
    const auto& p = preconditioners_.at_midpoint(x);
    if (recorder_) recorder_->newton(p, x);
    const certify::NewtonStep& step = step_.emplace(system_, p, x, workspace_);
    const certify::NewtonOutcome& newton = step.outcome();
    ++statistics.newton_steps;
    if (newton.empty || !step.contract_free(x)) return false;
    regular_ = newton.regular && p.rank() == system_.equations();
    noisy_ = is_noisy(x);
    worth_proving_ = regular_ && newton.spread < tuning_.proof_spread;
    near_sheet_ = regular_ && newton.spread < tuning_.sheet_spread;
    bool gained = false;
    for (int j = 0; j < n && !gained; ++j) gained = x[j].width() < (1 - tuning_.gain) * widths_[j];
    if (!gained) return true;
    if (!propagator_.run(system_, x, recorder_)) return false;
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
    const auto j = static_cast<std::size_t>(step_->dependent()[a]);
    if (relative_width(j) < kNarrow * widest) continue;
    const double noise = step_->noise(static_cast<int>(a)), width = x[j].width();
    if (noise > 0 && noise > (regular_ ? kRegularNoise : kNoise) * width) return true;
  }
  return false;
}

}  // namespace corank::solve
