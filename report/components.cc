#include "corank/report/components.h"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace corank::report {
namespace {

using certify::Box;
using certify::Interval;

bool touch(const Box& a, const Box& b, std::size_t n) {
  for (std::size_t j = 0; j < n; ++j)
    if (a[j].lo() > b[j].hi() || b[j].lo() > a[j].hi()) return false;
  return true;
}

/// The variables along which the boxes are most spread out, in edges of the widest box: three at most.
std::vector<std::size_t> grid_axes(const std::vector<certify::CoverBox>& boxes, std::size_t n, std::vector<double>& cell) {
  std::vector<double> spread(n);
  cell.assign(n, 0);
  for (std::size_t j = 0; j < n; ++j) {
    double lo = INFINITY, hi = -INFINITY;
    for (const auto& b : boxes) {
      lo = std::min(lo, b.box[j].lo());
      hi = std::max(hi, b.box[j].hi());
      cell[j] = std::max(cell[j], b.box[j].hi() - b.box[j].lo());
    }
    cell[j] = std::max(cell[j], (hi - lo) / 1024);  // points have no width
    spread[j] = cell[j] > 0 && std::isfinite(hi - lo) ? (hi - lo) / cell[j] : 0;
  }
  std::vector<std::size_t> axes(n);
  std::iota(axes.begin(), axes.end(), 0);
  std::stable_sort(axes.begin(), axes.end(), [&](std::size_t a, std::size_t b) { return spread[a] > spread[b]; });
  std::erase_if(axes, [&](std::size_t j) { return spread[j] == 0; });
  axes.resize(std::min<std::size_t>(axes.size(), 3));
  return axes;
}

}  // namespace

Components components(const Result& result) {
  const std::vector<certify::CoverBox>& boxes = result.cover.boxes;
  const auto n = static_cast<std::size_t>(result.configuration_size);
  std::vector<double> cell;
  const std::vector<std::size_t> axes = grid_axes(boxes, n, cell);

  // Boxes by the grid cells that they meet. A cell is as wide as the widest box, so a box meets two cells along each axis at most.
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells;
  boost::disjoint_sets_with_storage<> joined(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    std::vector<std::uint64_t> keys = {0};
    for (const std::size_t j : axes) {
      const Interval& side = boxes[i].box[j];
      const auto first = static_cast<std::int64_t>(std::floor(side.lo() / cell[j]));
      const auto last = static_cast<std::int64_t>(std::floor(side.hi() / cell[j]));
      std::vector<std::uint64_t> finer;
      for (const std::uint64_t key : keys)
        for (std::int64_t k = first; k <= last; ++k)
          finer.push_back(key * 0x1FFFFFFFFFFFFFB5u + static_cast<std::uint64_t>(k));
      keys = std::move(finer);
    }
    for (const std::uint64_t key : keys) {
      std::vector<std::size_t>& others = cells[key];
      for (const std::size_t other : others)
        if (joined.find_set(i) != joined.find_set(other) && touch(boxes[i].box, boxes[other].box, n))
          joined.union_set(i, other);
      others.push_back(i);
    }
  }

  Components found;
  std::unordered_map<std::size_t, int> numbers;
  std::vector<bool> proven;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const int component = numbers.emplace(joined.find_set(i), static_cast<int>(numbers.size())).first->second;
    found.of_box.push_back(component);
    proven.resize(numbers.size());
    const certify::Verdict verdict = boxes[i].verdict;
    if (verdict == certify::Verdict::regular || verdict == certify::Verdict::isolated || verdict == certify::Verdict::exact)
      proven[static_cast<std::size_t>(component)] = true;
  }
  found.count = static_cast<int>(numbers.size());
  found.with_proven_solution = static_cast<int>(std::count(proven.begin(), proven.end(), true));
  return found;
}

}  // namespace corank::report
