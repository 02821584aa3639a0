#include "corank/app/limited_run.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <utility>

#include "corank/app/command_control.h"
#include "corank/app/exit_status.h"
#include "corank/result/output_file.h"
#include "corank/symbolic/ginac_lock.h"

namespace corank::app {
namespace {

// Until the model's equations are there all is one piece of work; later each call of GiNaC is one.
Watch::Work deaf_work(const solve::Control& control) {
  constexpr Watch::Work kModel = ~Watch::Work{0};
  return control.stage() == solve::Stage::model ? kModel : symbolic::GinacLock::holder();
}

[[noreturn]] void give_up(const solve::Control& control) {
  control.ended();
  const auto ending = control.ending();
  fmt::print(stderr, "\ncorank: stopped by {} while equations were derived; there is no result\n",
             ending ? solve::to_string(ending->by) : "a limit");
  std::fflush(nullptr);
  result::remove_part_files();
  std::_Exit(kIncomplete);
}

}  // namespace

LimitedRun::LimitedRun(solve::Control::Limits limits)
    : control_(of_command(std::move(limits))),
      watch_(
          control_.limits().time, Interrupt::stop(), [this](const std::string&) { give_up(control_); }, Watch::kGrace,
          [this] { return deaf_work(control_); }) {}

}  // namespace corank::app
