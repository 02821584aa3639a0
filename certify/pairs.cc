#include "corank/certify/pairs.h"

#include <algorithm>

#include "corank/certify/compiled_system.h"
#include "corank/core/check.h"
#include "corank/core/rounding.h"

namespace corank::certify {

std::optional<std::vector<Box>> pairs(const std::vector<CoverBox>& boxes, const System& doubled, const PairLayout& layout,
                                      std::size_t most) {
  const std::size_t n = layout.first.size();
  CORANK_CHECK(n > 0 && layout.second.size() == n);
  System inequalities = doubled;
  inequalities.equations.clear();
  inequalities.implied.clear();
  const CompiledSystem compiled(inequalities);
  const UpwardRounding rounding;
  std::vector<std::size_t> shared;
  for (std::size_t j = 0; j < n; ++j)
    if (layout.first[j] == layout.second[j]) shared.push_back(j);
  // By the first shared side, so that those that overlap in it are not far.
  std::vector<const Box*> sorted;
  for (const CoverBox& b : boxes) {
    CORANK_CHECK(b.box.size() == n);
    sorted.push_back(&b.box);
  }
  const auto lower = [&](const Box* b) { return shared.empty() ? 0.0 : (*b)[shared[0]].lo(); };
  std::ranges::sort(sorted, [&](const Box* a, const Box* b) { return lower(a) < lower(b); });

  const Box domain = doubled.domain();
  std::vector<Box> result;
  const auto add = [&](const Box& a, const Box& b) {
    Box x = domain;
    for (std::size_t j = 0; j < n; ++j) {
      if (!x[layout.first[j]].intersect(a[j])) return;
      if (!x[layout.second[j]].intersect(b[j])) return;
    }
    for (int row = compiled.equations(); row < compiled.rows(); ++row)
      if (compiled.evaluate(row, x).hi() < 0) return;
    result.push_back(std::move(x));
  };
  for (std::size_t i = 0; i < sorted.size(); ++i)
    for (std::size_t k = i; k < sorted.size(); ++k) {
      const Box &a = *sorted[i], &b = *sorted[k];
      if (!shared.empty() && b[shared[0]].lo() > a[shared[0]].hi()) break;
      if (!std::ranges::all_of(shared, [&](std::size_t j) { return a[j].overlaps(b[j]); })) continue;
      add(a, b);
      if (k != i) add(b, a);
      if (result.size() > most) return std::nullopt;
    }
  return result;
}

}  // namespace corank::certify
