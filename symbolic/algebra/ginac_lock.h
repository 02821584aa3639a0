// GiNaC counts references without atomics, so one thread at a time may use it. Every public function of symbolic/ that calls
// GiNaC holds a GinacLock until its last GiNaC object is gone; nothing outside symbolic/ and kinematics/ ever sees one.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>

namespace corank::symbolic {

class GinacLock {
 public:
  GinacLock() : lock_(mutex_) {
    if (depth_++ == 0) current_ = ++number_;
  }
  ~GinacLock() {
    if (--depth_ == 0) current_ = 0;
  }
  GinacLock(const GinacLock&) = delete;
  GinacLock& operator=(const GinacLock&) = delete;

  /// The number of the outermost lock that is held, by any thread; 0: there is none.
  static std::uint64_t holder() { return current_; }

 private:
  static inline std::recursive_mutex mutex_;  // recursive: singularity_system calls derive
  static inline int depth_ = 0;               // of the thread that holds the mutex
  static inline std::uint64_t number_ = 0;
  static inline std::atomic<std::uint64_t> current_ = 0;
  std::lock_guard<std::recursive_mutex> lock_;
};

}  // namespace corank::symbolic
