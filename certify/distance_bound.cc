#include "corank/certify/distance_bound.h"

#include <algorithm>

#include "corank/certify/distance.h"
#include "corank/certify/numeric.h"
#include "corank/certify/polynomial_algebra.h"
#include "corank/core/box.h"

namespace corank::certify {

DistanceBound::DistanceBound(const System& system, const KeptDistances& distances)
    : tests_(distances.tests), arguments_(variables_of(distances.functions)), compiled_(system, distances.functions) {}

bool DistanceBound::holds(const Box& box, int halvings) const {
  if (holds_in_one(box)) return true;
  if (halvings == 0) return false;
  const auto halves = halved(box, arguments_, compiled_.scales());
  return halves && std::ranges::all_of(*halves, [&](const Box& half) { return holds(half, halvings - 1); });
}

bool DistanceBound::holds_in_one(const Box& box) const {
  const std::vector<double> c = midpoint(box);
  std::vector<Interval> offsets, slopes(compiled_.entries());
  for (const int j : arguments_) offsets.push_back(box[j] - Interval(c[j]));
  const auto form = [&](int function) {
    const int row = compiled_.value_row(function);
    compiled_.slopes(row, box, c.data(), slopes);
    AffineForm f{compiled_.evaluate_at(row, c.data()), std::vector<Interval>(arguments_.size())};
    for (int k = compiled_.row_begin(row); k < compiled_.row_begin(row + 1); ++k)
      f.slopes[std::ranges::lower_bound(arguments_, compiled_.column(k)) - arguments_.begin()] = slopes[k];
    return f;
  };
  return std::ranges::all_of(tests_,
                             [&](const DistanceTest& test) { return standing(test, form, offsets) == Standing::satisfied; });
}

}  // namespace corank::certify
