// Counts isolated solutions while a search goes on.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "corank/certify/distinct.h"
#include "corank/core/box_tree.h"

namespace corank::solve {

// Which isolated solutions have been found, as certify::compare_isolated sees it: what merge_isolated will remove or doubt
// at the end does not count.
class DistinctSolutions {
 public:
  void add(const certify::Sheet& sheet) {
    if (!images_) images_.emplace(sheet.image.size());
    std::vector<std::size_t> close;  // all others are different
    images_->for_each_overlapping(sheet.image, [&](std::size_t k) { close.push_back(k); });
    std::sort(close.begin(), close.end());
    bool unclear = false;
    for (const std::size_t k : close) {
      switch (certify::compare_isolated(known_[k].sheet, sheet)) {
        case certify::Identity::same: return;
        case certify::Identity::different: break;
        case certify::Identity::unknown:
          unclear = true;
          if (!known_[k].unclear) --clear_;
          known_[k].unclear = true;
          break;
      }
    }
    known_.push_back({sheet, unclear});
    images_->add(known_.back().sheet.image);
    if (!unclear) ++clear_;
  }
  std::uint64_t count() const { return clear_; }

 private:
  struct Known {
    certify::Sheet sheet;
    bool unclear;
  };
  std::deque<Known> known_;  // they stay where they are
  std::optional<GrowingBoxTree> images_;
  std::uint64_t clear_ = 0;
};

}  // namespace corank::solve
