// A path between two configurations, or the proof that there is none, as a page shows it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "corank/analyze/path.h"
#include "corank/core/system.h"
#include "corank/core/tube.h"

namespace corank::report {

struct PathView {
  analyze::Avoid avoid = analyze::Avoid::forward;
  analyze::Path path;
  double radius_asked = 0;
  System system;  ///< C-space: the variables of boxes and tube
  /// At the path's two ends.
  std::array<std::vector<analyze::PathFinder::Sign>, 2> signs;
  /// Of the ends and of each node: the model's coordinates, in doubles, angles along a tube without jumps.
  std::vector<std::string> names;
  std::array<std::vector<double>, 2> ends;
  std::vector<std::vector<double>> nodes;
};

PathView path_view(const analyze::PathFinder& finder, const analyze::Path& path);

/// A JSON object for the page's script: "status", the singularities "avoided", the "ends" and, of a tube, "nodes", "pieces"
/// and "radii", in the variables `order` (System::variables' names). Throws std::invalid_argument where the view has none of
/// such a name.
std::string path_json(const PathView& view, const std::vector<std::string>& order);

}  // namespace corank::report
