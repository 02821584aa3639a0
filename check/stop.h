// How a check ends early: whatever loops asks whether it is to.
#pragma once

#include <utility>

#include "corank/core/ended.h"
#include "corank/core/nearest_rounding.h"

namespace corank::check {

/// Thrown by StopFlag::poll; the checker catches it.
struct Stopped {};

class StopFlag {
 public:
  StopFlag() = default;
  explicit StopFlag(Ended ended) : ended_(std::move(ended)) {}
  bool is_set() const { return is_over(ended_); }
  /// Throws Stopped where the flag is set.
  void poll() const {
    if (is_set()) throw Stopped{};
  }

 private:
  Ended ended_;
};

/// Does work that may be stopped, with rounding to nearest. False: it was stopped.
template <class Work>
bool finishes(const Work& work) {
  const NearestRounding nearest;
  try {
    work();
    return true;
  } catch (const Stopped&) {
    return false;
  }
}

}  // namespace corank::check
