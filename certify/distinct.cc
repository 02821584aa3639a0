#include "corank/certify/distinct.h"

#include "corank/core/box.h"
#include "corank/core/check.h"

namespace corank::certify {

Identity compare_isolated(const Sheet& a, const Sheet& b) {
  CORANK_CHECK(a.proven && b.proven && a.dependent.size() == b.dependent.size() && a.region.size() == b.region.size());
  if (!overlap(a.image, b.image)) return Identity::different;
  if (contains(a.region, b.image) || contains(b.region, a.image)) return Identity::same;
  return Identity::unknown;
}

bool holds_nothing_else(const Sheet& sheet, std::span<const Interval> box) {
  CORANK_CHECK(sheet.proven);
  return contains(sheet.region, box);
}

bool is_solution_of_region(const ProvenZero& zero, const Reduction& reduction, const std::vector<Interval>& region) {
  CORANK_CHECK(zero.sides.size() == reduction.kept.size());
  if (reduction.tolerant || reduction.subset) return false;
  for (std::size_t j = 0; j < zero.sides.size(); ++j) {
    const Interval& side = region.at(reduction.kept[j]);
    const auto& [lower, upper] = zero.sides[j];
    if ((lower - ExactNumber::dyadic(side.lo())).sign() == -1 || (upper - ExactNumber::dyadic(side.hi())).sign() == 1)
      return false;
  }
  return true;
}

}  // namespace corank::certify
