// Ctrl-C: the first one asks the search to end with a valid, incomplete result, the second one ends the program at once.
#pragma once

#include <atomic>

namespace corank::app {

/// For the time of its life, SIGINT and SIGTERM set stop(); a second signal exits with status 128 + its number.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  static const std::atomic<bool>& stop();
};

}  // namespace corank::app
