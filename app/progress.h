// One line on a terminal that says how far the search is.
#pragma once

#include <string>

#include "corank/solve/solve.h"

namespace corank::app {

/// Draws on standard error where that is a terminal, else does nothing.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  bool visible() const { return visible_; }
  void show(const solve::Progress& progress);
  void show(const std::string& text);
  void clear();

 private:
  bool visible_;
  bool drawn_ = false;
};

}  // namespace corank::app
