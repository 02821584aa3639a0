#include "corank/solve/problem.h"

#include <algorithm>

namespace corank::solve {
namespace {

constexpr double kRedundantRankTolerance = 1e-7;  // of redundant equations near their solution
constexpr double kRoundedRankTolerance = 1e-4;    // of such with rounded coefficients

std::vector<certify::Polynomial> values_of(const certify::Reduction& reduction) {
  std::vector<certify::Polynomial> values;
  for (const auto& definition : reduction.definitions) values.push_back(definition.value);
  return values;
}

}  // namespace

Problem::Problem(const certify::Reduction& reduction, double s, std::function<bool()> e)
    : compiled(reduction.system, values_of(reduction)),
      redundant(reduction.system),
      domain(reduction.system),
      subset(reduction.subset),
      rank_tolerance(reduction.tolerant ? kRoundedRankTolerance : kRedundantRankTolerance),
      branching(reduction.system),
      sigma(s),
      ended(std::move(e)) {}

void Problem::append_values(certify::Box& sides) const {
  sides.resize(static_cast<std::size_t>(compiled.variables()));
  for (int k = 0; k < compiled.values(); ++k) sides.push_back(compiled.evaluate(compiled.value_row(k), sides.data()));
}

void Problem::append_values_at_zeros(const certify::Preconditioner& p, certify::Box& sides,
                                     certify::NewtonWorkspace& w) const {
  append_values(sides);
  const std::size_t n = static_cast<std::size_t>(compiled.variables());
  for (int k = 0; k < compiled.values(); ++k)
    sides[n + static_cast<std::size_t>(k)].intersect(
        certify::value_at_zeros(compiled, p, compiled.value_row(k), sides.data(), w));
}

std::vector<int> other_variables(const std::vector<int>& given, int variables) {
  std::vector<int> others;
  for (int j = 0; j < variables; ++j)
    if (std::find(given.begin(), given.end(), j) == given.end()) others.push_back(j);
  return others;
}

double widest(const certify::Box& x) {
  double width = 0;
  for (const certify::Interval& side : x) width = std::max(width, side.width());
  return width;
}

}  // namespace corank::solve
