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

std::vector<int> free_variables(const certify::Sheet& sheet, int variables) {
  std::vector<int> free;
  for (int j = 0; j < variables; ++j)
    if (std::find(sheet.dependent.begin(), sheet.dependent.end(), j) == sheet.dependent.end()) free.push_back(j);
  return free;
}

double widest(const certify::Box& x) {
  double width = 0;
  for (const certify::Interval& side : x) width = std::max(width, side.width());
  return width;
}

}  // namespace corank::solve
