// How a check ends early: whatever loops polls a flag, which somebody else sets.
#pragma once

#include <atomic>

namespace corank::check {

/// Thrown by StopFlag::poll; the checker catches it.
struct Stopped {};

class StopFlag {
 public:
  StopFlag() = default;
  explicit StopFlag(const std::atomic<bool>* flag) : flag_(flag) {}
  bool is_set() const { return flag_ && flag_->load(std::memory_order_relaxed); }
  /// Throws Stopped where the flag is set.
  void poll() const {
    if (is_set()) throw Stopped{};
  }

 private:
  const std::atomic<bool>* flag_ = nullptr;
};

}  // namespace corank::check
