// The part of a command line that asks about a ball: of which set, about which centre, in which coordinates.
#pragma once

#include <string>
#include <vector>

#include "corank/app/question.h"
#include "corank/app/shared_options.h"

namespace corank::app {

/// "NAME=[A,B]", or "NAME=±D" about the value of NAME in `at`. Throws UsageError.
analyze::NamedRange range_of(const std::string& text, const std::vector<analyze::NamedValue>& at,
                             const std::string& option = "--range");

struct BallCommand {
  QuestionOptions question;
  SearchLimits limits{};  // one thread for each core
  std::vector<std::string> at, in, ranges;
  std::string orientation_range;
  OrientationOptions orientation;

  /// The model, the set, the ball, and what ends the search. `required`: when --in is.
  void add_options(CLI::App& sub, const std::string& required = "");
  /// Throws UsageError without --at or --in. `except`: where they may be missing.
  void require_center(const std::string& except = "") const;
  analyze::BallOptions ball() const;
  /// Of the set forward, or requirements where some are given, where none is said.
  study::Question load() const;
  solve::Options search() const;
};

}  // namespace corank::app
