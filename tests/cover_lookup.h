// Is a point in some box of a cover?
#pragma once

#include <algorithm>
#include <vector>

#include "corank/core/cover.h"

namespace corank::test {

/// Samples in closed form carry rounding errors of some ulps, more where two circles nearly touch (√ε).
inline constexpr double kSampleTolerance = 1e-7;

/// Finds points by the first coordinates of boxes, the boxes sorted by their lower end along the first.
class CoverLookup {
 public:
  explicit CoverLookup(const Cover& cover) {
    for (const auto& b : cover.boxes) boxes_.push_back(&b.box);
    std::sort(boxes_.begin(), boxes_.end(), [](auto* a, auto* b) { return (*a)[0].lo() < (*b)[0].lo(); });
    for (const auto* b : boxes_) widest_ = std::max(widest_, (*b)[0].width());
  }

  /// The leading coordinates of some box, widened by tolerance (for samples computed in floating point), hold the point.
  template <class Point>
  bool holds(const Point& p, double tolerance) const {
    const auto begin = std::lower_bound(boxes_.begin(), boxes_.end(), p[0] - widest_ - tolerance,
                                        [](auto* b, double value) { return (*b)[0].lo() < value; });
    for (auto at = begin; at != boxes_.end() && (**at)[0].lo() <= p[0] + tolerance; ++at) {
      bool inside = true;
      for (std::size_t j = 0; j < p.size() && inside; ++j)
        inside = p[j] >= (**at)[j].lo() - tolerance && p[j] <= (**at)[j].hi() + tolerance;
      if (inside) return true;
    }
    return false;
  }

 private:
  std::vector<const Box*> boxes_;
  double widest_ = 0;
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
