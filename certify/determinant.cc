#include "corank/certify/determinant.h"

#include <bit>
#include <vector>

#include "corank/core/check.h"
#include "corank/core/rounding.h"

namespace corank::certify {

Interval determinant(const IntervalMatrix& a) {
  constexpr int kLargest = 12;
  CORANK_CHECK(UpwardRounding::active() && a.rows == a.columns && a.rows <= kLargest);
  const std::size_t sets = std::size_t{1} << a.rows;
  std::vector<Interval> minors(sets, Interval(0));
  minors[0] = Interval(1);
  for (std::size_t s = 1; s < sets; ++s) {
    const int row = std::popcount(s) - 1;
    for (int j = 0; j < a.columns; ++j) {
      const std::size_t bit = std::size_t{1} << j;
      if ((s & bit) == 0) continue;
      const Interval term = a(row, j) * minors[s ^ bit];
      // The columns of S behind j: so many transpositions bring j to the end.
      if (std::popcount(s >> (j + 1)) % 2 == 0)
        minors[s] += term;
      else
        minors[s] -= term;
    }
  }
  return minors.back();
}

}  // namespace corank::certify
