// A path as one HTML file that needs no other: the mechanism moves along it, over the loci that it keeps away from.
// doc/paths.md describes it for users.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "corank/analyze/paths/path.h"
#include "corank/analyze/postures/cuspidal.h"
#include "corank/core/system.h"
#include "corank/core/tube.h"
#include "corank/report/html/set_view.h"
#include "corank/symbolic/model/mechanism.h"

namespace corank::report {

/// A path between two configurations, or the proof that there is none, as the page shows it.
struct PathView {
  analyze::Avoid avoid = analyze::Avoid::forward;
  analyze::Path path;
  double radius_asked = 0;
  bool cuspidal = false;  ///< the ends are two postures at one pose, or two poses for one position of the motors
  System system;          ///< C-space: the variables of boxes and tube
  /// At the path's two ends.
  std::array<std::vector<analyze::PathFinder::Sign>, 2> signs;
  /// Of the ends and of each node: the model's coordinates, in doubles, angles along a tube without jumps.
  std::vector<std::string> names;
  std::array<std::vector<double>, 2> ends;
  std::vector<std::vector<double>> nodes;
};

PathView path_view(const analyze::PathFinder& finder, const analyze::Path& path);
/// Of the path that proves it. `robot`: with a path.
PathView cuspidal_view(const analyze::Cuspidality& robot);

/// A JSON object for the page's script: "status", what is "avoided", the "ends" and, of a tube, "nodes", "pieces"
/// and "radii", in the variables `order` (System::variables' names). Throws std::invalid_argument where the view has none of
/// such a name.
std::string path_json(const PathView& view, const std::vector<std::string>& order);

struct PathPageOptions {
  std::string command;                 ///< that made it; shown
  std::string file{};                  ///< of the tube, shown and linked; empty: none
  std::vector<std::string> missing{};  ///< titles of sets that were sought and are not drawn
};

/// `sets`: what the portraits show of the mechanism, as far as it is known.
std::string path_page(const symbolic::Mechanism& mechanism, const PathView& view, const std::vector<SetView>& sets,
                      const PathPageOptions& options = {});

// Its parts, in words and as HTML fragments.

struct PathWords : Findings {
  std::string kicker;   ///< "A path without forward singularities"
  std::string finding;  ///< "There is a path, proven from end to end."
};

PathWords path_words(const symbolic::Mechanism& mechanism, const PathView& view);

/// "J_{3x} = 0.5, θ₂ = 3.002 …": the model's own coordinates.
std::string values_html(const PathView& view, const std::vector<double>& values, const symbolic::Mechanism& mechanism);

/// A table of the sign functions with the sign of each at both ends. Empty if there are no sign functions.
std::string signs_html(const PathView& view);

/// A table of the waypoints, with the radius that follows each; empty without a path.
std::string waypoints_html(const PathView& view, const symbolic::Mechanism& mechanism);

}  // namespace corank::report
