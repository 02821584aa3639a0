// What commands say at their end, and what their exit status means to scripts.
#pragma once

#include <stdexcept>
#include <string>

#include "corank/result/values/result.h"
#include "corank/solve/step/control.h"

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

/// Warns, where a set is empty, of a robot that cannot be assembled, of decimals that contradict each other. True: it did.
bool warn_of_assembly(const result::Result& result);
/// Says what ended an analysis early whose numbers are proven at any time: solve::stopped_by().
ExitStatus stopped_early(const std::string& stopped);
/// The same of proven bounds; without a limit they may be wide as well.
ExitStatus not_close(const std::string& stopped);
/// ", stopped by the time limit, in the stage search"; empty where nothing has ended it.
std::string ending_words(const solve::Control& control);

}  // namespace corank::app
