// What corank's exit status means to scripts.
#pragma once

#include <stdexcept>

namespace corank::app {

enum ExitStatus : int {
  kDone = 0,              ///< done and complete
  kBadInput = 1,          ///< the model, or a file that cannot be read or written
  kUsage = 2,             ///< the command line
  kIncomplete = 3,        ///< a limit or an interrupt ended the work; the result is valid
  kNotShownComplete = 4,  ///< corank verify: every claim holds, but nothing proves that no solution is missing
  kNotAssembled = 5,      ///< corank solve: done; the set is empty because the robot cannot be assembled within its ranges
  kBug = 70,              ///< a broken invariant of corank itself (EX_SOFTWARE)
};

/// A command line that makes no sense although its grammar is right.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace corank::app
