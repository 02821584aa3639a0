// The run of a subcommand: what ends it is a limit of time or a signal, which all that has a control looks at. GiNaC and
// FLINT do not: for them there is a watch, which ends the program.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

#include "corank/app/watch.h"
#include "corank/solve/step/control.h"

namespace corank::app {

/// The limits with Interrupt::stop(), with the clock, and the knowledge that the process ends with the command.
solve::Control::Limits of_command(solve::Control::Limits limits);

/// For its life all controls of commands ask this clock in place of the machine's: tests end a command at any question.
class ClockOfCommands {
 public:
  explicit ClockOfCommands(std::function<double()> clock);
  ~ClockOfCommands();
  ClockOfCommands(const ClockOfCommands&) = delete;
  ClockOfCommands& operator=(const ClockOfCommands&) = delete;
};

/// The piece of a run's work that may not end when it is asked to, for a Watch. Until the first search begins, all is one
/// piece: the model's equations, their reduction, what the search sets up; nothing is found by then. Later each call of
/// GiNaC is one.
Watch::Work deaf_work(const solve::Control& control);

/// Of a command whose answer is valid at any time. Everything that has a control ends soon after the limit of time or the
/// first signal. Where one piece of deaf_work() goes on for Watch::kGrace after that, the program ends with a statement, by
/// exit status kIncomplete; no file is left half written.
class LimitedRun {
 public:
  explicit LimitedRun(solve::Control::Limits limits);

  solve::Control& control() { return control_; }

 private:
  Interrupt interrupt_;
  solve::Control control_;
  Watch watch_;
};

/// Says what ended the run: "stopped by the time limit while reading the model; the output is not complete".
class Stopped : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Of a command that gives the whole of its output or none. Work that does not ask whether it is to end goes on for
/// Watch::kGrace after the limit or the first signal; then the program ends with Stopped's sentence, by exit status
/// kIncomplete. No file is left half written.
class WholeRun {
 public:
  /// Seconds, from now on; 0: no limit.
  explicit WholeRun(double time_limit);

  /// What is done from now on, in words for the sentence: "reading the model". Throws Stopped where the run is to end.
  void enter(const std::string& work);
  /// As solve::Control::ended(), for work that asks.
  bool ended() const { return control_.ended(); }
  solve::Control& control() { return control_; }

 private:
  Interrupt interrupt_;
  solve::Control control_;
  Watch watch_;
};

}  // namespace corank::app
