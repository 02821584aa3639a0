// One line on a terminal that says which stage a run is in, and how far it is.
#pragma once

#include <chrono>
#include <string>

#include "corank/solve/step/control.h"

namespace corank::app {

/// Draws on standard error where that is a terminal, else does nothing.
class ProgressLine {
 public:
  /// Between two pictures of the same stage.
  static constexpr std::chrono::milliseconds kRefreshInterval{100};

  /// `task` stands before all else, such as "forward (2 of 4)".
  explicit ProgressLine(std::string task = "");
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  bool visible() const { return visible_; }
  /// Shows how far the run under this control is; the line has to outlive it.
  void follow(solve::Control& control);
  void show(const solve::SearchProgress& progress);
  void show(const solve::Control::Progress& progress);
  void show(const std::string& text);
  void clear();

 private:
  std::string task_;
  bool visible_;
  bool drawn_ = false;
  solve::Stage stage_ = solve::Stage::search;
  std::chrono::steady_clock::time_point next_{};  // no picture of the same stage before
};

}  // namespace corank::app
