#include "corank/app/command_control.h"

#include <utility>

#include "corank/app/interrupt.h"

namespace corank::app {
namespace {

std::function<double()> the_clock;  // empty: the machine's

}  // namespace

solve::Control::Limits of_command(solve::Control::Limits limits) {
  limits.stop = &Interrupt::stop();
  limits.clock = the_clock;
  limits.leaves_memory = true;
  return limits;
}

ClockOfCommands::ClockOfCommands(std::function<double()> clock) { the_clock = std::move(clock); }
ClockOfCommands::~ClockOfCommands() { the_clock = {}; }

}  // namespace corank::app
