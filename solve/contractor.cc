#include "corank/solve/contractor.h"

namespace corank::solve {
namespace {

// Measured on Dextar's sets, see bench/HISTORY.md.
constexpr double kNewtonGain = 0.3;  // repeat Newton while some variable loses this share
constexpr int kNewtonRepeats = 4;
constexpr double kProofSpread = 1.5;               // try a proof below this spread |I − Y·S|
constexpr double kNoise = 0.5, kRegularNoise = 8;  // of a side: what rounding alone makes as wide is divided in vain

}  // namespace

bool Contractor::run(std::span<Interval> x, Statistics& statistics) {
  worth_proving_ = regular_ = noisy_ = false;
  if (!propagator_.run(system_, x, recorder_)) return false;
  const int n = system_.variables();
  widths_.resize(static_cast<std::size_t>(n));
  for (int repeat = 0; repeat < kNewtonRepeats; ++repeat) {
    for (int j = 0; j < n; ++j) widths_[j] = x[j].width();
    const auto& p = preconditioners_.at_midpoint(x);
    if (recorder_) recorder_->newton(p, x);
    const certify::NewtonStep& step = step_.emplace(system_, p, x, workspace_);
    const certify::NewtonOutcome& newton = step.outcome();
    ++statistics.newton_steps;
    if (newton.empty || !step.contract_free(x)) return false;
    regular_ = newton.regular && p.rank() == system_.equations();
    noisy_ = is_noisy(x);
    worth_proving_ = regular_ && newton.spread < kProofSpread;
    bool gained = false;
    for (int j = 0; j < n && !gained; ++j) gained = x[j].width() < (1 - kNewtonGain) * widths_[j];
    if (!gained) return true;
    if (!propagator_.run(system_, x, recorder_)) return false;
  }
  return true;
}

// Does rounding make what the equations say at a point as uncertain as the box is wide?
bool Contractor::is_noisy(std::span<const Interval> x) const {
  for (std::size_t a = 0; a < step_->dependent().size(); ++a) {
    const double noise = step_->noise(static_cast<int>(a));
    const double width = x[static_cast<std::size_t>(step_->dependent()[a])].width();
    if (noise > 0 && noise > (regular_ ? kRegularNoise : kNoise) * width) return true;
  }
  return false;
}

}  // namespace corank::solve
