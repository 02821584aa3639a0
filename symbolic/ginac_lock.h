// GiNaC counts references without atomics, so one thread at a time may use it. Every public function of symbolic/ that calls
// GiNaC holds a GinacLock until its last GiNaC object is gone; nothing outside symbolic/ and kinematics/ ever sees one.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>

namespace corank::symbolic {

class GinacLock {
 public:
  GinacLock() : lock_(mutex()) {
    if (depth()++ == 0) current() = ++number();
  }
  ~GinacLock() {
    if (--depth() == 0) current() = 0;
  }
  GinacLock(const GinacLock&) = delete;
  GinacLock& operator=(const GinacLock&) = delete;

  /// The number of the outermost lock that is held, by any thread; 0: there is none.
  static std::uint64_t holder() { return current(); }

 private:
  // Recursive: singularity_system calls derive.
  static std::recursive_mutex& mutex() {
    static std::recursive_mutex the_mutex;
    return the_mutex;
  }
  static int& depth() {  // of the thread that holds the mutex
    static int the_depth = 0;
    return the_depth;
  }
  static std::uint64_t& number() {
    static std::uint64_t the_number = 0;
    return the_number;
  }
  static std::atomic<std::uint64_t>& current() {
    static std::atomic<std::uint64_t> the_current = 0;
    return the_current;
  }
  std::lock_guard<std::recursive_mutex> lock_;
};

}  // namespace corank::symbolic
