// One line on a terminal that says how far the search is.
#pragma once

#include <string>

#include "corank/solve/solve.h"

namespace corank::app {

/// Draws on standard error where that is a terminal, else does nothing.
class ProgressLine {
 public:
  /// `task` stands before all else, such as "forward (2 of 4)".
  explicit ProgressLine(std::string task = "");
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  bool visible() const { return visible_; }
  /// Shows how far the search with these options is; the line has to outlive it.
  void follow(solve::Options& options);
  void show(const solve::Progress& progress);
  void show(const std::string& text);
  void clear();

 private:
  std::string task_;
  bool visible_;
  bool drawn_ = false;
};

}  // namespace corank::app
