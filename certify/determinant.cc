#include "corank/certify/determinant.h"

#include <bit>
#include <utility>
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

int determinant_sign(IntervalMatrix a) {
  CORANK_CHECK(a.rows == a.columns && UpwardRounding::active());
  const int n = a.rows;
  int sign = 1;
  for (int k = 0; k < n; ++k) {
    int row = k, column = k;
    double best = 0;
    for (int i = k; i < n; ++i)
      for (int j = k; j < n; ++j)
        if (a(i, j).mig() > best) best = a(i, j).mig(), row = i, column = j;
    if (best == 0) return 0;
    if (row != k) sign = -sign;
    if (column != k) sign = -sign;
    for (int j = 0; j < n; ++j) std::swap(a(row, j), a(k, j));
    for (int i = 0; i < n; ++i) std::swap(a(i, column), a(i, k));
    const Interval pivot = a(k, k);
    if (pivot.hi() < 0) sign = -sign;
    for (int i = k + 1; i < n; ++i) {
      const auto share = divide(a(i, k), pivot, Interval::whole());
      if (!share || !share->is_bounded()) return 0;
      for (int j = k + 1; j < n; ++j) a(i, j) -= *share * a(k, j);
    }
  }
  return sign;
}

}  // namespace corank::certify
