#include "corank/certify/determinant_sign.h"

#include <cmath>
#include <utility>

#include "corank/core/check.h"
#include "corank/core/rounding.h"

namespace corank::certify {

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
