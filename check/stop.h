// How a check ends early: whatever loops asks whether it is to.
#pragma once

#include <utility>

#include "corank/core/ended.h"

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

}  // namespace corank::check
