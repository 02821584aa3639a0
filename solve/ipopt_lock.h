// MUMPS, Ipopt's linear solver, keeps its state in global variables: one thread of a process may use Ipopt at a time.
#pragma once

#include <mutex>

namespace corank::solve {

class IpoptLock {
 public:
  IpoptLock() : lock_(mutex()) {}

 private:
  static std::mutex& mutex() {
    static std::mutex the_mutex;
    return the_mutex;
  }
  std::lock_guard<std::mutex> lock_;
};

}  // namespace corank::solve
