// What is asked of boxes, side by side.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "corank/core/interval.h"

namespace corank {

/// Makes a box hold another one of as many sides or more: each side becomes the hull of both.
inline void include(std::span<Interval> hull, std::span<const Interval> box) {
  for (std::size_t j = 0; j < hull.size(); ++j) hull[j] = Interval::hull(hull[j], box[j]);
}

/// Of the sides that both have: each of `inner` is in that of `outer`.
inline bool contains(std::span<const Interval> outer, std::span<const Interval> inner) {
  const std::size_t sides = std::min(outer.size(), inner.size());
  return std::equal(outer.begin(), outer.begin() + sides, inner.begin(),
                    [](const Interval& out, const Interval& in) { return out.contains(in); });
}

/// Each side of the first box becomes what it has in common with the other's, as long as there is something.
inline bool intersect(std::span<Interval> box, std::span<const Interval> other) {
  for (std::size_t j = 0; j < box.size(); ++j)
    if (!box[j].intersect(other[j])) return false;
  return true;
}

/// Have two boxes with the same number of sides a point in common?
inline bool overlap(std::span<const Interval> a, std::span<const Interval> b) {
  return std::equal(a.begin(), a.end(), b.begin(), [](const Interval& x, const Interval& y) { return x.overlaps(y); });
}

/// The k-th of n equal parts of a side, up to rounding; neighbours share their end.
inline Interval part_of(const Interval& side, int k, int n) {
  const auto at = [&](int j) { return j == n ? side.hi() : side.lo() + (side.hi() - side.lo()) * j / n; };
  return {at(k), at(k + 1)};
}

/// Those of the variables 0 … variables − 1 that are not in the list, ascending.
inline std::vector<int> all_but(std::span<const int> list, int variables) {
  std::vector<int> others;
  for (int j = 0; j < variables; ++j)
    if (std::ranges::find(list, j) == list.end()) others.push_back(j);
  return others;
}

/// Interval::mid() of each side.
inline std::vector<double> midpoint(std::span<const Interval> box) {
  std::vector<double> middle;
  for (const Interval& side : box) middle.push_back(side.mid());
  return middle;
}

}  // namespace corank
