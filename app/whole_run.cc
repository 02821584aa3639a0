#include "corank/app/whole_run.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

#include "corank/app/command_control.h"
#include "corank/app/exit_status.h"
#include "corank/result/output_file.h"

namespace corank::app {
namespace {

std::string sentence(const solve::Control& control, const std::string& work) {
  const auto ending = control.ending();
  return fmt::format("stopped by {} while {}; the output is not complete", ending ? to_string(ending->by) : "a limit", work);
}

[[noreturn]] void give_up(const solve::Control& control, const std::string& work) {
  control.ended();
  fmt::print(stderr, "corank: {}\n", sentence(control, work));
  std::fflush(stderr);  // standard output may be what the work waits for
  result::remove_part_files();
  std::_Exit(kIncomplete);
}

}  // namespace

void add_time_limit(CLI::App& command, double& seconds) {
  command.add_option("--time-limit", seconds, "End after SECONDS, without output; 0: no limit (default)")
      ->type_name("SECONDS")
      ->check(CLI::NonNegativeNumber);
}

WholeRun::WholeRun(double time_limit)
    : control_(of_command({.time = time_limit})),
      watch_(control_.limits().time, Interrupt::stop(), [this](const std::string& work) { give_up(control_, work); }) {}

void WholeRun::enter(const std::string& work) {
  watch_.enter(work);
  if (control_.ended()) throw Stopped(sentence(control_, work));
}

}  // namespace corank::app
