// Counts isolated solutions while a search goes on.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "corank/certify/distinct.h"

namespace corank::solve {

// Which isolated solutions have been found, as certify::compare_isolated sees it: what merge_isolated will remove or doubt at
// the end does not count.
class DistinctSolutions {
 public:
  void add(const certify::Sheet& sheet) {
    bool unclear = false;
    for (Known& known : known_) {
      switch (certify::compare_isolated(known.sheet, sheet)) {
        case certify::Identity::same: return;
        case certify::Identity::different: break;
        case certify::Identity::unknown: unclear = known.unclear = true; break;
      }
    }
    known_.push_back({sheet, unclear});
  }
  std::uint64_t count() const {
    return static_cast<std::uint64_t>(
        std::count_if(known_.begin(), known_.end(), [](const Known& k) { return !k.unclear; }));
  }

 private:
  struct Known {
    certify::Sheet sheet;
    bool unclear;
  };
  std::vector<Known> known_;
};

}  // namespace corank::solve
