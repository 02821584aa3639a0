// The run of a command that gives the whole of its output or none: a limit of time or a signal ends it with one sentence.
#pragma once

#include <CLI/CLI.hpp>
#include <stdexcept>
#include <string>

#include "corank/app/interrupt.h"
#include "corank/app/watch.h"
#include "corank/solve/control.h"

namespace corank::app {

/// Says what ended the run: "stopped by the time limit while reading the model; the output is not complete".
class Stopped : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// --time-limit, of such a command.
void add_time_limit(CLI::App& command, double& seconds);

class WholeRun {
 public:
  /// Seconds, from now on; 0: no limit. Work that does not ask whether it is to end goes on for Watch::kGrace after the
  /// limit or the first signal; then the program ends with Stopped's sentence, by exit status kIncomplete. No file is left
  /// half written.
  explicit WholeRun(double time_limit);

  /// What is done from now on, in words for the sentence: "reading the model". Throws Stopped where the run is to end.
  void enter(const std::string& work);
  /// As solve::Control::ended(), for work that asks.
  bool ended() const { return control_.ended(); }

 private:
  Interrupt interrupt_;
  solve::Control control_;
  Watch watch_;
};

}  // namespace corank::app
