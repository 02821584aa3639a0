#include "corank/solve/step/branching.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "corank/certify/polynomial_algebra.h"
#include "corank/solve/step/heuristics.h"

namespace corank::solve {
namespace {

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

// The equations of two variables or more that share none with another equation or an inequality.
std::vector<int> equations_alone(const System& system) {
  std::vector<int> uses(system.variables.size(), 0);
  for (const auto* list : {&system.equations, &system.inequalities})
    for (const Polynomial& f : *list)
      for (const int v : certify::variables_of(f)) ++uses[v];
  std::vector<int> result;
  for (std::size_t row = 0; row < system.equations.size(); ++row) {
    const std::vector<int> own = certify::variables_of(system.equations[row]);
    if (own.size() > 1 && std::ranges::all_of(own, [&](int v) { return uses[v] == 1; }))
      result.push_back(static_cast<int>(row));
  }
  return result;
}

}  // namespace

BranchingRule::BranchingRule(const System& system, double kernel_weight, int kernel_vectors)
    : weight_(system.variables.size(), 1.0), patience_(system.variables.size(), 1.0), alone_(equations_alone(system)) {
  const auto defined = linearly_defined(system);
  const auto is_kernel = [](const Variable& v) { return v.kind == VariableKind::kernel; };
  const bool late =
      kernel_vectors == 1 && system.dimension() <= 1 && std::ranges::count_if(system.variables, is_kernel) >= kManyUnknowns;
  for (std::size_t j = 0; j < weight_.size(); ++j) {
    if (is_kernel(system.variables[j])) {
      weight_[j] = late ? kLateWeight * kernel_weight : kernel_weight;
      if (late && system.dimension() <= 0) patience_[j] = kLatePatience;
    }
    if (defined[j]) weight_[j] = 0;
  }
  for (const Polynomial& f : system.equations)
    if (const std::vector<int> own = certify::variables_of(f); own.size() == 1) weight_[own[0]] = kAloneWeight;
  if (std::ranges::all_of(weight_, [](double w) { return w == 0; })) std::ranges::fill(weight_, 1.0);
}

std::optional<double> split_point(const Interval& side) {
  const double at = (1 - kBisectionPoint) * side.lo() + kBisectionPoint * side.hi();
  return at > side.lo() && at < side.hi() ? std::optional(at) : std::nullopt;
}

std::vector<double> BranchingRule::smear(const certify::CompiledSystem& system, std::span<const Interval> x) const {
  std::vector<double> result(weight_.size(), 0.0), part(weight_.size());
  std::vector<Interval> jacobian(system.entries());
  system.jacobian(x, jacobian);
  for (int row = 0; row < system.equations(); ++row) {
    const int begin = system.row_begin(row), end = system.row_begin(row + 1);
    double sum = 0;
    for (int k = begin; k < end; ++k) {
      const std::size_t j = system.column(k);
      sum += part[j] = jacobian[k].mag() * x[j].width();
    }
    if (!(sum > 0 && std::isfinite(sum))) continue;
    for (int k = begin; k < end; ++k) {
      const std::size_t j = system.column(k);
      result[j] += std::sqrt(part[j] / sum);
    }
  }
  return result;
}

std::vector<bool> BranchingRule::settled(const certify::CompiledSystem& system, std::span<const Interval> x) const {
  std::vector<bool> result;
  if (alone_.empty()) return result;
  result.resize(weight_.size(), false);
  std::vector<Interval> jacobian(system.entries());
  system.jacobian(x, jacobian);
  for (const int row : alone_) {
    const auto begin = jacobian.begin() + system.row_begin(row), end = jacobian.begin() + system.row_begin(row + 1);
    if (std::none_of(begin, end, [](const Interval& d) { return d.width() < kSettledShare * d.mig(); })) continue;
    for (int k = system.row_begin(row); k < system.row_begin(row + 1); ++k) result[system.column(k)] = true;
  }
  if (std::ranges::none_of(result, [](bool settled) { return settled; })) result.clear();
  return result;
}

int BranchingRule::choose(const certify::CompiledSystem& system, std::span<const Interval> x,
                          const std::vector<double>& limits, const certify::NewtonStep* step) const {
  const std::vector<double> smears = smear(system, x);
  std::vector<double> of_step(weight_.size(), 0.0);
  if (step) step->add_smears(x, of_step);
  const bool has_step = std::ranges::any_of(of_step, [](double t) { return t > 0; });
  int best = -1, widest = -1;
  double best_score = 0, widest_width = 0;
  for (std::size_t j = 0; j < weight_.size(); ++j) {
    if (x[j].width() <= limits[j] || !split_point(x[j])) continue;
    const double width = std::min(x[j].width(), std::numeric_limits<double>::max()) / system.scales()[j];
    const double product = smears[j] * (has_step ? of_step[j] : smears[j]);
    const double score = weight_[j] * width * std::max(product * product, kLeastSmear);
    if (score > best_score) best_score = score, best = static_cast<int>(j);
    if (width > widest_width) widest_width = width, widest = static_cast<int>(j);
  }
  return best >= 0 ? best : widest;
}

}  // namespace corank::solve
