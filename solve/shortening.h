// Which rational multiple of one equation, added to another, leaves that with the fewest terms? (c) of certify/reduction.h.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "corank/core/system.h"

namespace corank::solve {

/// Exact arithmetic with such numbers takes minutes, and intervals of doubles gain nothing by it: more than 2,000 bits.
bool has_long_number(const Polynomial& f);

/// rows[row] + factor · rows[other] has so many terms fewer than rows[row]; saved = 0: there is no such pair.
struct BestShortening {
  std::size_t row = 0, other = 0;
  ExactNumber factor;
  std::ptrdiff_t saved = 0;
};
/// Of all pairs the first that saves most. Rows with long numbers stay out of it. `check` is called for each pair.
BestShortening best_shortening(const std::vector<Polynomial>& rows, const std::function<void()>& check);

}  // namespace corank::solve
