// Is a point in some box of a cover?
#pragma once

#include <algorithm>
#include <map>
#include <span>
#include <vector>

#include "corank/core/box_tree.h"
#include "corank/core/cover.h"

namespace corank::test {

/// Samples in closed form carry rounding errors of some ulps, more where two circles nearly touch (√ε).
inline constexpr double kSampleTolerance = 1e-7;

class CoverLookup {
 public:
  explicit CoverLookup(const Cover& cover) : cover_(cover) {}

  /// The leading coordinates of some box, widened by tolerance (for samples computed in floating point), hold the point.
  bool holds(std::span<const double> p, double tolerance) const {
    bool found = false;
    for_each(p, tolerance, [&](const CoverBox&) { found = true; });
    return found;
  }
  /// Calls visit(box) for each box that holds the point so.
  template <class Visit>
  void for_each(std::span<const double> p, double tolerance, Visit visit) const {
    auto tree = trees_.find(p.size());
    if (tree == trees_.end()) tree = trees_.try_emplace(p.size(), boxes(), p.size()).first;
    tree->second.for_each_overlapping(Box(p.begin(), p.end()), tolerance, [&](std::size_t k) { visit(cover_.boxes[k]); });
  }

 private:
  std::vector<const Box*> boxes() const {
    std::vector<const Box*> list;
    for (const CoverBox& b : cover_.boxes) list.push_back(&b.box);
    return list;
  }

  const Cover& cover_;
  mutable std::map<std::size_t, BoxTree> trees_;  ///< by the number of leading coordinates
};

// Of the configuration's first `coordinates` variables in proven boxes, which σ is about.
inline double widest_edge(const Cover& cover, int coordinates) {
  double width = 0;
  for (const auto& b : cover.boxes)
    for (int j = 0; j < coordinates && b.verdict != Verdict::undecided; ++j)
      width = std::max(width, b.box[static_cast<std::size_t>(j)].width());
  return width;
}

}  // namespace corank::test
