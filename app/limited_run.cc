#include "corank/app/limited_run.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <utility>

#include "corank/app/exit_status.h"
#include "corank/result/files/output_file.h"
#include "corank/symbolic/algebra/ginac_lock.h"

namespace corank::app {
namespace {

std::function<double()> the_clock;  // empty: the machine's

std::string ended_by(const solve::Control& control) {
  const auto ending = control.ending();
  return ending ? to_string(ending->by) : "a limit";
}

std::string sentence(const solve::Control& control, const std::string& work) {
  return fmt::format("stopped by {} while {}; the output is not complete", ended_by(control), work);
}

[[noreturn]] void give_up(const std::string& message, std::FILE* flushed) {
  fmt::print(stderr, "{}\n", message);
  std::fflush(flushed);
  result::remove_part_files();
  std::_Exit(kIncomplete);
}

}  // namespace

Watch::Work deaf_work(const solve::Control& control) {
  constexpr Watch::Work kSetUp = ~Watch::Work{0};
  const bool nothing_found = control.stage() <= solve::Stage::reduction && !control.has_counted();
  return nothing_found ? kSetUp : symbolic::GinacLock::holder();
}

solve::Control::Limits of_command(solve::Control::Limits limits) {
  limits.stop = &Interrupt::stop();
  limits.clock = the_clock;
  limits.leaves_memory = true;
  return limits;
}

ClockOfCommands::ClockOfCommands(std::function<double()> clock) { the_clock = std::move(clock); }
ClockOfCommands::~ClockOfCommands() { the_clock = {}; }

LimitedRun::LimitedRun(solve::Control::Limits limits)
    : control_(of_command(std::move(limits))),
      watch_(
          control_.limits().time, Interrupt::stop(),
          [this](const std::string&) {
            control_.ended();
            give_up(fmt::format("\ncorank: stopped by {} while the question was prepared; there is no result",
                                ended_by(control_)),
                    nullptr);
          },
          Watch::kGrace, [this] { return deaf_work(control_); }) {}

WholeRun::WholeRun(double time_limit)
    : control_(of_command({.time = time_limit})),
      watch_(control_.limits().time, Interrupt::stop(), [this](const std::string& work) {
        control_.ended();
        give_up("corank: " + sentence(control_, work), stderr);  // standard output may be what the work waits for
      }) {}

void WholeRun::enter(const std::string& work) {
  watch_.enter(work);
  if (control_.ended()) throw Stopped(sentence(control_, work));
}

}  // namespace corank::app
