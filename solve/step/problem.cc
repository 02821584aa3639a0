#include "corank/solve/step/problem.h"

#include <algorithm>

#include "corank/core/rounding.h"
#include "corank/solve/step/heuristics.h"
#include "corank/solve/step/propagation.h"

namespace corank::solve {
std::vector<Polynomial> values_of(const certify::Reduction& reduction) {
  std::vector<Polynomial> values;
  for (const auto& definition : reduction.definitions) values.push_back(definition.value);
  return values;
}

Problem::Problem(const System& system, const certify::Reduction& reduction, std::function<bool()> e)
    : compiled(reduction.system, values_of(reduction)),
      redundant(reduction.system),
      domain(reduction.system),
      subset(reduction.subset),
      tolerant(reduction.tolerant || redundant.applies()),
      rank_tolerance(reduction.tolerant ? kRoundedRankTolerance : kRedundantRankTolerance),
      branching(reduction.system, 1, system.kernel_vectors),
      heuristics(heuristics_for(reduction.system, tolerant)),
      ended(e ? std::move(e) : [] { return false; }),
      classes_(sigma_classes(system, reduction)) {
  TypicalSizes sizes = typical_sizes(compiled, reduction.system.domain());
  compiled.set_scales(std::move(sizes.variables));
  equation_sizes = std::move(sizes.equations);
  if (!compiled.parameters().empty())
    tolerance_width = std::min(kToleranceShare * change_by_parameters(reduction.system.domain()), kWidestTolerance);
}

// The largest change of an equation, beside what all unknowns make of it. That one of them is known as well as the
// parameters are says nothing of the others.
double Problem::change_by_parameters(const Box& whole) const {
  const UpwardRounding rounding;
  std::vector<Interval> jacobian(compiled.entries());
  compiled.jacobian(whole, jacobian);
  double largest = 0;
  for (int row = 0; row < compiled.equations(); ++row) {
    double change = 0, size = 0;
    for (int k = compiled.row_begin(row); k < compiled.row_begin(row + 1); ++k) {
      const int j = compiled.column(k);
      const bool varies = std::ranges::binary_search(compiled.parameters(), j);
      double& sum = varies ? change : size;
      sum += jacobian[k].mag() * (varies ? 0.5 * whole[j].width() : whole[j].mag());
    }
    if (size > 0) largest = std::max(largest, change / size);
  }
  return largest;
}

void Problem::set_sigma(const Sigma& s) {
  sigma.clear();
  for (const SigmaClass kind : classes_) sigma.push_back(sigma_of(s, kind));
}

std::vector<double> Problem::limits(double share) const {
  std::vector<double> result;
  for (std::size_t j = 0; j < compiled.scales().size(); ++j) {
    result.push_back(2 * share * branching.patience(static_cast<int>(j)) * compiled.scales()[j]);
    if (tolerant) result.back() = std::min(result.back(), sigma[j]);
  }
  return result;
}

double Problem::excess(const Box& sides, const std::vector<double>& sigma) {
  double largest = 0;
  for (std::size_t j = 0; j < sides.size(); ++j) largest = std::max(largest, sides[j].width() / sigma[j]);
  return largest;
}

bool Problem::may_be_part(std::span<const Interval> x) const {
  if (!parts_of_sheets) return false;
  Box sides(x.begin(), x.begin() + compiled.variables());
  if (excess(sides, sigma) > 1) return false;
  append_values(sides);
  return excess(sides, sigma) <= kCutMargin;  // the eliminated variables' sides get room, too
}

double Problem::relative_width(std::span<const Interval> x) const {
  double largest = 0;
  for (std::size_t j = 0; j < compiled.scales().size(); ++j)
    largest = std::max(largest, x[j].width() / (2 * compiled.scales()[j]));
  return largest;
}

void Problem::append_values(Box& sides) const {
  sides.resize(compiled.variables());
  for (int k = 0; k < compiled.values(); ++k) sides.push_back(compiled.evaluate(compiled.value_row(k), sides));
}

void Problem::append_values_at_zeros(const certify::NewtonStep& step, Box& sides) const {
  append_values(sides);
  const std::size_t n = compiled.variables();
  for (int k = 0; k < compiled.values(); ++k) sides[n + k].intersect(step.value_at_zeros(compiled.value_row(k), sides));
}

std::vector<int> Problem::without_parameters(std::vector<int> variables) const {
  std::erase_if(variables, [&](int j) { return std::ranges::binary_search(compiled.parameters(), j); });
  return variables;
}

}  // namespace corank::solve
