#include "corank/check/growing_parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace corank::check {
namespace {

bool is_mixed(const SignCell& cell, std::size_t function) {
  return std::ranges::find(cell.mixed, function) != cell.mixed.end();
}

}  // namespace

std::vector<std::size_t> in_the_way(const SignParts& parts, const std::vector<GrowingPart>& passages,
                                    const std::vector<int>& signs) {
  SignParts::Directions common = passages.front().directions;
  bool grow = true;
  std::vector<std::size_t> in_all = passages.front().cell->mixed;
  std::map<std::size_t, double> largest, smallest;  // 1/w of K, the functions that are mixed somewhere
  for (const GrowingPart& p : passages) {
    if (p.sheet != passages.front().sheet) common.reset();
    common &= p.directions;
    grow = grow && p.grows;
    std::erase_if(in_all, [&](std::size_t k) { return !is_mixed(*p.cell, k); });
    for (const std::size_t k : p.cell->mixed) {
      const double size = std::max(-p.cell->range[k].lo(), p.cell->range[k].hi());
      largest[k] = std::max(largest[k], size);
      smallest[k] = std::min(smallest.emplace(k, size).first->second, size);
    }
  }
  if (common.any() || (grow && !in_all.empty())) return {};
  std::vector<std::size_t> result(passages.size());
  std::iota(result.begin(), result.end(), std::size_t{0});
  const auto keep_fewer = [&](const std::map<std::size_t, double>& sizes) {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < passages.size(); ++i) {
      const GrowingPart& p = passages[i];
      std::vector<std::size_t> growing = p.cell->mixed;
      const auto weighed = [&](std::size_t k, double size) {
        return (signs[k] > 0 ? p.cell->range[k] : -p.cell->range[k]) * Enclosure(1 / size);
      };
      double least = HUGE_VAL;
      for (const auto& [k, size] : sizes) least = std::min(least, weighed(k, size).hi());
      for (const auto& [k, size] : sizes)
        if (!is_mixed(*p.cell, k) && weighed(k, size).lo() <= least) growing.push_back(k);
      const bool all_grow = growing.size() == p.cell->mixed.size() ? p.grows : parts.grow_together(*p.cell, growing, signs);
      if (!all_grow) open.push_back(i);
    }
    if (open.size() < result.size()) result = std::move(open);
  };
  // K: all, or all but one.
  for (const std::map<std::size_t, double>& all : {largest, smallest}) {
    if (result.empty()) break;
    keep_fewer(all);
    for (auto k = all.begin(); k != all.end() && all.size() > 1 && !result.empty(); ++k) {
      std::map<std::size_t, double> others = all;
      others.erase(k->first);
      keep_fewer(others);
    }
  }
  return result;
}

}  // namespace corank::check
