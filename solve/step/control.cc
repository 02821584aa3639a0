#include "corank/solve/step/control.h"

#include <chrono>
#include <limits>

namespace corank::solve {
namespace {

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Control::Limits with_clock(Control::Limits limits) {
  if (!limits.clock) limits.clock = steady_seconds;
  return limits;
}

constexpr int kStages = 256;

}  // namespace

const char* to_string(Stage stage) {
  constexpr std::array kNames{"model",        "reduction",         "search",   "merging", "collecting points",
                              "exact points", "kernel dimensions", "decimals", "writing", "figures",
                              "page"};
  return kNames.at(static_cast<std::size_t>(stage));
}

const char* to_string(Limit limit) {
  constexpr std::array kNames{"the time limit",           "an interrupt",       "the box limit",
                              "the limit of boxes found", "the solution limit", "the memory limit"};
  return kNames.at(static_cast<std::size_t>(limit));
}

std::string to_string(const Ending& ending) {
  return std::string(to_string(ending.by)) + ", in the stage " + to_string(ending.stage);
}

Control::Control(Limits limits)
    : limits_(with_clock(std::move(limits))), deadline_(limits_.time > 0 ? limits_.clock() + limits_.time : 0) {}

void Control::note(Limit by) const {
  int none = -1;
  ending_.compare_exchange_strong(none, static_cast<int>(by) * kStages + static_cast<int>(stage_.load()));
}

std::optional<Ending> Control::ending() const {
  const int ending = ending_;
  if (ending < 0) return std::nullopt;
  return Ending{static_cast<Limit>(ending / kStages), static_cast<Stage>(ending % kStages)};
}

bool Control::ended() const {
  if (ended_.load(std::memory_order_relaxed)) return true;
  if (limits_.stop && limits_.stop->load(std::memory_order_relaxed)) {
    note(Limit::interrupt);
  } else if (limits_.time > 0 && limits_.clock() >= deadline_) {
    note(Limit::time);
  } else {
    return false;
  }
  if (double never = 0; ended_at_.compare_exchange_strong(never, limits_.clock())) ended_ = true;
  return true;
}

double Control::seconds_left() const {
  return limits_.time > 0 ? deadline_ - limits_.clock() : std::numeric_limits<double>::infinity();
}

Control::Limits Control::rest(double seconds, std::uint64_t boxes) const {
  Limits limits = limits_;
  limits.leaves_memory = false;  // the run goes on
  if (limits.boxes > 0) limits.boxes = std::max<std::uint64_t>(boxes_left(), 1);
  if (boxes > 0) limits.boxes = limits.boxes > 0 ? std::min(limits.boxes, boxes) : boxes;
  if (limits.time > 0) limits.time = std::max(seconds_left(), 1e-9);
  if (seconds > 0) limits.time = limits.time > 0 ? std::min(limits.time, seconds) : seconds;
  return limits;
}

bool Control::overdue(double seconds) const { return ended() && limits_.clock() - ended_at_ >= seconds; }

bool Control::search_ended() const {
  if (ended()) return true;
  if (limits_.memory && kept_.load(std::memory_order_relaxed) > static_cast<std::int64_t>(limits_.memory)) {
    note(Limit::memory);
    return true;
  }
  return false;
}

bool Control::count_box() {
  if (search_ended()) return false;
  if (boxes_.fetch_add(1, std::memory_order_relaxed) < limits_.boxes || limits_.boxes == 0) return true;
  note(Limit::boxes);
  return false;
}

std::string stopped_by(const Control& control) {
  static_cast<void>(control.ended());  // a part with a control of its own may have seen the time limit first
  const auto ending = control.ending();
  return ending ? to_string(*ending) : "";
}

void Control::report(std::uint64_t done, std::uint64_t all) const {
  if (progress) progress({stage_, done, all});
}

InStage::InStage(Control& control, Stage stage) : control_(control) {
  if (control.depth_++ > 0) return;
  control.stage_ = stage;
  control.report(0, 0);
}

}  // namespace corank::solve
