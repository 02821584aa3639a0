#include "corank/app/interrupt.h"

#include <csignal>
#include <cstdlib>

#include "corank/result/output_file.h"

namespace corank::app {
namespace {

std::atomic<bool> stop_flag = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch lock-free atomics only");

extern "C" void on_signal(int signal) {
  if (!stop_flag.exchange(true)) return;
  result::remove_part_files();
  std::_Exit(128 + signal);
}

}  // namespace

Interrupt::Interrupt() {
  stop_flag = false;
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

Interrupt::~Interrupt() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

const std::atomic<bool>& Interrupt::stop() { return stop_flag; }

}  // namespace corank::app
