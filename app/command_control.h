// What every control of a command has in common: the signals that end it, and its clock.
#pragma once

#include <functional>

#include "corank/solve/control.h"

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

}  // namespace corank::app
