// GiNaC counts references without atomics, so one thread at a time may use it. Every public function of symbolic/ that calls
// GiNaC holds a GinacLock until its last GiNaC object is gone; nothing outside symbolic/ and kinematics/ ever sees one.
#pragma once

#include <mutex>

namespace corank::symbolic {

class GinacLock {
 public:
  GinacLock() : lock_(mutex()) {}

 private:
  // Recursive: singularity_system calls derive.
  static std::recursive_mutex& mutex() {
    static std::recursive_mutex the_mutex;
    return the_mutex;
  }
  std::lock_guard<std::recursive_mutex> lock_;
};

}  // namespace corank::symbolic
