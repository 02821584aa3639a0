#include "corank/solve/branching.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace corank::solve {
namespace {

using certify::Function;
using certify::Polynomial;
using certify::System;

// The variable x_j of a x_j = Σ b_i f_i(x_i) + b_0, each f_i a sine or cosine and at least one of them there; −1 for another
// equation.
int value_of_functions(const Polynomial& f) {
  int value = -1;
  bool function = false;
  for (const auto& m : f.monomials) {
    function = function || m.is_trigonometric();
    if (m.factors.empty() || m.is_trigonometric()) continue;
    if (value >= 0 || m.degree() > 1) return -1;
    value = m.factors[0].variable;
  }
  return function ? value : -1;
}

// x_j occurs in one equation only, there linearly with a constant coefficient, and in no inequality; or an equation says
// that x_j is a sum of sines, cosines and constants, whose arguments are the better ones to bisect.
std::vector<bool> linearly_defined(const System& system) {
  const std::size_t n = system.variables.size();
  std::vector<int> rows(n, 0);
  std::vector<bool> linear(n, false), function(n, false);
  const auto count = [&](const Polynomial& f, bool inequality) {
    std::set<int> seen;
    for (const auto& m : f.monomials)
      for (const auto& factor : m.factors) {
        if (seen.insert(factor.variable).second) rows[factor.variable] += inequality ? 2 : 1;
        linear[factor.variable] = m.factors.size() == 1 && factor.power == 1 && factor.function == Function::identity;
        if (factor.function != Function::identity) function[factor.variable] = true;
      }
  };
  for (const Polynomial& f : system.equations) count(f, false);
  for (const Polynomial& g : system.inequalities) count(g, true);
  for (std::size_t j = 0; j < n; ++j) linear[j] = linear[j] && rows[j] == 1 && !function[j];
  for (const Polynomial& f : system.equations)
    if (const int j = value_of_functions(f); j >= 0 && !function[j]) linear[j] = true;
  return linear;
}

// Variables of an equation Σ a_i x_i² = b that every other equation holds homogeneously, one of them in each monomial: a kernel
// vector and its norm, whoever wrote the system.
std::set<int> kernel_like(const System& system) {
  std::set<int> result;
  for (const Polynomial& norm : system.equations) {
    std::set<int> group;
    bool squares = true;
    for (const auto& m : norm.monomials) {
      if (m.factors.empty()) continue;
      squares = squares && m.factors.size() == 1 && m.factors[0].power == 2;
      group.insert(m.factors[0].variable);
    }
    if (!squares || group.empty()) continue;
    bool homogeneous = true, used = false;
    for (const Polynomial& f : system.equations) {
      if (&f == &norm) continue;
      std::size_t with = 0;
      for (const auto& m : f.monomials) {
        int degree = 0;
        for (const auto& factor : m.factors)
          if (group.count(factor.variable))
            degree += factor.function == Function::identity ? factor.power : 2;  // 2: neither
        if (degree > 1) homogeneous = false;
        if (degree == 1) ++with;
      }
      if (with != 0 && with != f.monomials.size()) homogeneous = false;
      used = used || with != 0;
    }
    if (homogeneous && used) result.insert(group.begin(), group.end());
  }
  return result;
}

}  // namespace

BranchingRule::BranchingRule(const System& system) : weight_(system.variables.size(), 1.0) {
  const auto defined = linearly_defined(system);
  const auto kernel = kernel_like(system);
  for (std::size_t j = 0; j < weight_.size(); ++j) {
    const auto& v = system.variables[j];
    if (v.kind == certify::VariableKind::kernel || kernel.count(static_cast<int>(j))) weight_[j] = 0.5;
    if (defined[j]) weight_[j] = 0;
    const double width = v.domain.width();
    inverse_width_.push_back(width > 0 ? 1 / width : 0);  // an overflowing width counts as the largest double
    if (!std::isfinite(width)) inverse_width_.back() = 1 / std::numeric_limits<double>::max();
  }
  if (std::all_of(weight_.begin(), weight_.end(), [](double w) { return w == 0; }))
    std::fill(weight_.begin(), weight_.end(), 1.0);
}

std::optional<double> split_point(const certify::Interval& side) {
  const double at = (1 - kBisectionPoint) * side.lo() + kBisectionPoint * side.hi();
  return at > side.lo() && at < side.hi() ? std::optional(at) : std::nullopt;
}

int BranchingRule::choose(const certify::Interval* x, double sigma) const {
  int best = -1, widest = -1;
  double best_score = 0, widest_width = sigma;
  for (std::size_t j = 0; j < weight_.size(); ++j) {
    const double width = std::min(x[j].width(), std::numeric_limits<double>::max());
    const double share = width * inverse_width_[j];
    if (width <= sigma && (share <= kProofShare || weight_[j] == 0)) continue;
    if (!split_point(x[j])) continue;
    const double score = weight_[j] * share;
    if (score > best_score) best_score = score, best = static_cast<int>(j);
    if (width > widest_width) widest_width = width, widest = static_cast<int>(j);
  }
  return best >= 0 ? best : widest;
}

}  // namespace corank::solve
