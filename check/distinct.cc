#include "corank/check/distinct.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "corank/core/box.h"

namespace corank::check {

std::vector<std::pair<std::size_t, std::size_t>> meeting_pairs(const std::vector<const Box*>& boxes,
                                                               const std::function<bool(std::size_t, std::size_t)>& apart,
                                                               std::size_t limit) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  if (boxes.size() < 2) return pairs;
  const std::size_t n = boxes[0]->size();
  std::size_t along = 0;
  double most = -1;
  for (std::size_t j = 0; j < n; ++j) {
    double least = HUGE_VAL, greatest = -HUGE_VAL;
    for (const Box* b : boxes) least = std::min(least, (*b)[j].lo()), greatest = std::max(greatest, (*b)[j].lo());
    if (greatest - least > most) most = greatest - least, along = j;
  }
  std::vector<std::size_t> order(boxes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (n > 0)
    std::ranges::sort(order,
                      [&](std::size_t a, std::size_t b) { return (*boxes[a])[along].lo() < (*boxes[b])[along].lo(); });
  std::vector<std::size_t> active;  // boxes whose side along the sweep may reach the present one
  for (const std::size_t i : order) {
    std::erase_if(active, [&](std::size_t k) { return n > 0 && (*boxes[k])[along].hi() < (*boxes[i])[along].lo(); });
    for (const std::size_t k : active) {
      if (!overlap(*boxes[i], *boxes[k]) || apart(std::min(i, k), std::max(i, k))) continue;
      if (pairs.size() == limit) return pairs;
      pairs.emplace_back(std::min(i, k), std::max(i, k));
    }
    active.push_back(i);
  }
  return pairs;
}

}  // namespace corank::check
