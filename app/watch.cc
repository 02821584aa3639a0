#include "corank/app/watch.h"

#include <algorithm>
#include <csignal>
#include <cstdlib>

#include "corank/result/files/output_file.h"

namespace corank::app {
namespace {

std::atomic<bool> stop_flag = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch lock-free atomics only");

extern "C" void on_signal(int signal) {
  if (!stop_flag.exchange(true)) return;
  result::remove_part_files();
  std::_Exit(128 + signal);
}

using Clock = std::chrono::steady_clock;

constexpr Watch::Duration kGlance{0.02};  // between two looks at the interrupt
constexpr double kLongest = 1e8;          // seconds: what a clock can add

Clock::time_point later(Clock::time_point from, Watch::Duration duration) {
  return from + std::chrono::duration_cast<Clock::duration>(duration);
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

Watch::Watch(double seconds, const std::atomic<bool>& interrupt, std::function<void(const std::string&)> give_up,
             Duration grace, std::function<Work()> deaf)
    : give_up_(std::move(give_up)),
      deaf_(std::move(deaf)),
      thread_([this, seconds, &interrupt, grace] { watch(seconds, interrupt, grace); }) {}

Watch::~Watch() {
  done();
  thread_.join();
}

void Watch::enter(const std::string& stage) {
  const std::lock_guard lock(mutex_);
  stage_ = stage;
}

void Watch::done() {
  const std::lock_guard lock(mutex_);
  done_ = true;
  changed_.notify_all();
}

void Watch::watch(double seconds, const std::atomic<bool>& interrupt, Duration grace) {
  const Clock::time_point end = later(Clock::now(), Duration(seconds > 0 ? std::min(seconds, kLongest) : kLongest));
  std::unique_lock lock(mutex_);
  while (!done_ && !interrupt && Clock::now() < end)
    changed_.wait_until(lock, std::min(end, later(Clock::now(), kGlance)), [this] { return done_; });
  stop_ = true;
  stop_.notify_all();
  // With the lock, so that done() waits for a statement that is being made.
  const auto work = [this] { return deaf_ ? deaf_() : 1; };
  Work known = work();
  for (Clock::time_point since = Clock::now(); !done_ && (known == 0 || Clock::now() < later(since, grace));) {
    changed_.wait_until(lock, later(Clock::now(), kGlance), [this] { return done_; });
    if (const Work now = work(); now != known || now == 0) known = now, since = Clock::now();
  }
  if (!done_) give_up_(stage_);
}

}  // namespace corank::app
