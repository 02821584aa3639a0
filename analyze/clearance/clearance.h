// Clearance: the largest ball about a configuration, in coordinates of choice, that holds no singularity, with bounds that
// are proven from both sides.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "corank/analyze/clearance/ball.h"
#include "corank/analyze/sets/nearest.h"
#include "corank/core/requirement.h"
#include "corank/result/values/result.h"

namespace corank::analyze {

struct ClearanceOptions {
  double precision = 0.01;   ///< of the radius, relative
  bool check_center = true;  ///< is there a configuration at the centre?
  double keep = 0;           ///< where > 0: is the radius at least this? The search ends once that is known
  std::function<void(double lower, std::optional<double> upper, std::uint64_t processed)> progress{};
};

struct CoordinateValue {
  std::string name;
  Interval value;  ///< an angle in radians
};

/// Of the model's coordinates over a box of the system's variables.
std::vector<CoordinateValue> coordinate_values(const System& system, const Box& box);

struct Clearance {
  enum class Center { assembled, not_assembled, unknown };

  Ball ball;
  double precision = 0.01;
  Center center = Center::unknown;
  Nearest nearest;
  std::vector<CoordinateValue> at;  ///< of the ball's coordinates, the centre's enclosures
  /// Of several requirements: whose limit the nearest proven one is, an index in the model's.
  std::optional<std::size_t> requirement{};
  std::vector<CoordinateValue> values;                    ///< of the nearest proven singularity: the model's coordinates
  std::vector<CoordinateValue> robot;                     ///< that has it: its constants, those with a tolerance
  std::vector<std::pair<std::string, double>> seemingly;  ///< of a nearer point where nothing could be proven; no claim
  /// Of each configuration at the centre, where that was examined: does it meet the requirements whose limits are avoided?
  std::vector<Standing> postures{};
  std::string stopped;  ///< what ended the search early; empty: nothing
  double seconds = 0;

  /// No singularity among the configurations in question is nearer: where there is none at all, the ball's room, which may
  /// be infinite.
  double lower() const { return nearest.empty ? ball.room : nearest.lower; }
  /// Of the largest ball of which it is proven that it lies in what was searched and holds no singularity.
  double free_radius() const { return std::min(lower(), ball.room); }
};

/// Throws ModelError where the question makes no sense or no configuration is at the centre.
Clearance clearance(const study::Question& question, const BallOptions& ball, const ClearanceOptions& options,
                    const solve::Options& search, solve::Control& control);

/// A number that is no larger, no smaller, with six digits.
std::string rounded(double x, bool up);
/// For a terminal: a line for each, with its middle.
std::string value_lines(const std::vector<CoordinateValue>& values);
/// "stopped by the time limit, in the stage search" as the last line of an analysis' table; empty where nothing did.
std::string stopped_line(const std::string& stopped);
/// "radius in [0.1, 0.2], 300 boxes": of a search that is under way.
std::string progress_text(double lower, const std::optional<double>& upper, std::uint64_t count, const std::string& what);
/// A few lines for a terminal.
std::string to_table(const Clearance& clearance);
/// {"model", "set", "at": {name: value}, "in": [names], "radius": {"lo", "hi" (null: none was proven)}, "nearest" (null, or
/// {name: {"lo", "hi"}}), "robot" (that has it: {constant with a tolerance: {"lo", "hi"}}), "requirement" (of several: whose
/// limit that is), "empty", "room" (null: infinite), "end" (that the ball meets at that radius), "ball" (free_radius()),
/// "seemingly" (null, or {"distance", "values"}), "center", "complete", "stopped", "precision", "processed", "seconds"}.
std::string to_json(const Clearance& clearance);

/// What a clearance claims, but for a millionth of the radius, as results that corank verify checks like any other, with
/// code that shares nothing with the search.
///
/// "No singularity is nearer than the lower bound": the set of the ball's model within that radius, whose cover is empty and
/// has its proof of completeness. Where a limit or degenerate solutions end the search before that, boxes are left.
result::Result claim_free(const Clearance& clearance, const solve::Options& search, solve::Control& control);

/// "There is a singularity no farther than the upper bound": the set within that radius, of whose cover this is one box. It
/// holds a solution for the values of its free variables, which are points. Nothing where there is none, or none can be
/// proven so near the edge.
std::optional<result::Result> claim_nearest(const Clearance& clearance, solve::Control& control);

}  // namespace corank::analyze
