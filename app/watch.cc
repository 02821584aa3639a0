#include "corank/app/watch.h"

#include <algorithm>

namespace corank::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr Watch::Duration kGlance{0.02};  // between two looks at the interrupt
constexpr double kLongest = 1e8;          // seconds: what a clock can add

Clock::time_point later(Clock::time_point from, Watch::Duration duration) {
  return from + std::chrono::duration_cast<Clock::duration>(duration);
}

}  // namespace

Watch::Watch(double seconds, const std::atomic<bool>& interrupt, std::function<void(const std::string&)> give_up,
             Duration grace)
    : give_up_(std::move(give_up)), thread_([this, seconds, &interrupt, grace] { watch(seconds, interrupt, grace); }) {}

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
  changed_.wait_until(lock, later(Clock::now(), grace), [this] { return done_; });
  if (!done_) give_up_(stage_);
}

}  // namespace corank::app
