// Which variable to bisect. Heuristic throughout.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "corank/certify/compiled_system.h"
#include "corank/certify/newton.h"
#include "corank/core/system.h"

namespace corank::solve {

/// Where to bisect a side; nothing where it is too narrow for doubles to divide.
std::optional<double> split_point(const Interval& side);

class BranchingRule {
 public:
  /// `kernel_weight`: how much sooner than others the unknowns of a kernel vector are bisected. `kernel_vectors`: of the
  /// system that was reduced to this one (System::kernel_vectors).
  explicit BranchingRule(const System& system, double kernel_weight = 1, int kernel_vectors = 1);

  /// The variable to bisect for an unproven box: the one of largest s² t² · width / typical size
  /// (certify::CompiledSystem::scales) among those wider than their limit; −1 where there is none that can be divided. s is
  /// the sum over the equations i of √(|J_ij| w_j / Σ_k |J_ik| w_k), the variable's share in what makes each uncertain:
  /// relative smear (key Trombettoni2011), where the root favours a variable of many equations. t is the same for the rows
  /// of the box's last Newton step, which a narrower side must make contract; s where there is none. Root and powers are
  /// measured, see bench/HISTORY.md. A variable that a linear equation or a sine or cosine defines waits until all others
  /// are narrow. One that has an equation of its own, such as c² = 1, goes first: it has few values, each a set apart. On
  /// curves and points, six or more unknowns of a kernel vector wait until the configuration is narrow.
  int choose(const certify::CompiledSystem& system, std::span<const Interval> x, const std::vector<double>& limits,
             const certify::NewtonStep* step = nullptr) const;

  /// Of each variable: is it one of an equation that shares no variable with any other, such as the circle of a motor that
  /// turns freely, and is that equation's solution in x a sheet? The set is a product with that sheet, and dividing x along
  /// it helps nothing. Empty where there is no such equation.
  std::vector<bool> settled(const certify::CompiledSystem& system, std::span<const Interval> x) const;

  const std::vector<double>& weights() const { return weight_; }
  /// How much wider than another variable, in typical sizes, x_j may be when a box is small enough to be put off: not 1 only
  /// for the unknowns of a kernel vector of many whose configurations are isolated. There the directions of ξ in a box that
  /// narrower sides of q would empty are too many to be told apart, and they wait.
  double patience(int j) const { return patience_[j]; }

 private:
  std::vector<double> smear(const certify::CompiledSystem& system, std::span<const Interval> x) const;

  std::vector<double> weight_;  // 0: defined by others, see branching.cc
  std::vector<double> patience_;
  std::vector<int> alone_;  // the equations that share no variable
};

}  // namespace corank::solve
