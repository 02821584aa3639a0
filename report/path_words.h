// A path in words: what was found, what of it is proven, and what is not. HTML fragments.
#pragma once

#include <string>
#include <vector>

#include "corank/report/path_view.h"
#include "corank/symbolic/mechanism.h"

namespace corank::report {

struct PathWords {
  std::string kicker;                         ///< "A path without forward singularities"
  std::string finding;                        ///< "There is a path, proven from end to end."
  std::vector<std::string> proven, unproven;  ///< one sentence each
};

PathWords path_words(const symbolic::Mechanism& mechanism, const PathView& view);

/// "J_{3x} = 0.5, θ₂ = 3.002 …".
std::string values_html(const PathView& view, const std::vector<double>& values, const std::vector<std::string>& shown);

/// A table: of each sign function its sign at both ends; empty where there is none.
std::string signs_html(const PathView& view);

/// A table of the waypoints, with the radius that follows each; empty without a path.
std::string waypoints_html(const PathView& view, const symbolic::Mechanism& mechanism);

}  // namespace corank::report
