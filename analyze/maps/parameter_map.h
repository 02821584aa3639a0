// A number over a plane of two parameters, constants or coordinates: cells of the plane over which it is the same, proven
// (certify/solution_count.h), or where no such proof is known, its value at the centres of cells.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "corank/analyze/maps/critical_points.h"
#include "corank/core/map_claims.h"
#include "corank/result/values/claim_files.h"
#include "corank/solve/step/control.h"
#include "corank/study/question.h"
#include "corank/symbolic/sets/parameters.h"

namespace corank::analyze {

/// solutions: of a set of dimension 0, proven all over cells. The others belong to single mechanisms, and are known at the
/// centres alone.
enum class MapAnswer { solutions, components, aspects, assembly_modes, working_modes };
/// "solutions", "components", "aspects", "assembly-modes", "working-modes".
const char* to_string(MapAnswer answer);
std::optional<MapAnswer> map_answer_from_string(const std::string& text);

struct MapQuestion {
  study::Question question;                        ///< its set: of MapAnswer::solutions
  std::vector<symbolic::Parameter> over;           ///< two
  std::vector<symbolic::FixedCoordinate> fixed{};  ///< of MapAnswer::solutions
  MapAnswer answer = MapAnswer::solutions;
  std::string solutions = "system";  ///< how those of a plain system are called
};

struct ParameterMapOptions {
  int resolution = 64;       ///< how many of the narrowest cells are along each side: a power of two, 8 … 1024
  bool boundary = true;      ///< look for the curve on which solutions meet, in cells that are left undecided
  bool cusps = false;        ///< find the cusps and nodes of that curve, and the number of aspects (critical_points.h)
  bool certificate = false;  ///< of MapAnswer::solutions: keep what proves the cells' numbers
  int threads = 1;           ///< tiles at once; 0: one for each core
  std::function<void(std::size_t done, std::size_t all)> progress{};  ///< of tiles; from any thread, one at a time
};
inline constexpr int kTiles = 8;  ///< along each side

struct MapCellAnswer {
  enum class Kind {
    proven,     ///< `count` for every value of the parameters in the cell, of every robot within the tolerances
    undecided,  ///< nothing is known of the whole cell
    centre,     ///< nobody asked for more than the centre
    pending     ///< not examined: a limit
  };
  Box sides;
  Kind kind = Kind::pending;
  std::optional<int> count{};      ///< proven
  std::optional<int> at_centre{};  ///< proven for the cell's centre alone
  /// Of a proven cell with solutions, where requirements are asked for. satisfied: for every value in the cell each solution
  /// meets them all; violated: for every value one does not.
  std::optional<Standing> standing{};
  std::vector<MapSheet> sheets{};  ///< of a proven cell, where a certificate is asked for
};
const char* to_string(MapCellAnswer::Kind kind);

/// In the plane of the parameters. proven: the box holds a piece of the curve on which two solutions meet; else it may.
struct MapBoundaryBox {
  Box sides;
  bool proven = false;
};

/// A part of a map, which depends on nothing but the question, the resolution and its number.
struct MapTile {
  int number = 0;
  std::vector<MapCellAnswer> cells{};
  std::vector<MapBoundaryBox> boundary{};
  bool boundary_known = false;  ///< as ParameterMap's
  std::uint64_t processed = 0;  ///< boxes
};

struct ParameterMap {
  std::string model, set;  ///< "cspace", "forward-cusps" …; MapQuestion::solutions
  MapAnswer answer = MapAnswer::solutions;
  std::vector<std::string> names;  ///< of the parameters
  Box region;
  std::vector<std::pair<std::string, std::string>> fixed;
  std::vector<std::string> require;  ///< of MapAnswer::solutions: the model's requirements
  /// Of MapAnswer::solutions: every number, requirement and piece of the boundary is one of each robot within these.
  std::vector<std::pair<std::string, Interval>> tolerances;
  int resolution = 0;
  std::vector<MapCellAnswer> cells;      ///< sorted by their lower ends; they share sides, and cover the region
  std::vector<MapBoundaryBox> boundary;  ///< likewise sorted
  bool boundary_known = false;  ///< the boundary's boxes hold all points of undecided cells at which two solutions meet
  std::optional<CriticalPoints> critical;  ///< where they are asked for
  bool complete = false;
  std::string stopped;  ///< what ended it early; empty: nothing
  std::uint64_t processed = 0;
  double seconds = 0;
  std::optional<MapClaims> claims;  ///< of the proven cells, where a certificate was asked for

  /// The share of the region's area that is proven to have each count; of centre answers, the share of the cells.
  std::map<int, double> shares() const;
  double proven_share() const;
  /// The share where requirements are satisfied, or violated; open: all the rest but what has no solutions.
  double share_where(Standing standing) const;
  double share_of(const MapCellAnswer& cell) const;
};

/// Made once for all tiles; its tiles may be made by several threads at once.
class ParameterMapper {
 public:
  /// Throws symbolic::ModelError where the set has another dimension than 0 over fixed parameters, has parts or is that of a
  /// type, where there are not two parameters, or a constant of a robot from parts is asked for, whose equations depend on
  /// it.
  ParameterMapper(MapQuestion question, const ParameterMapOptions& options);
  ~ParameterMapper();
  ParameterMapper(ParameterMapper&&) noexcept;

  static constexpr int tiles() { return kTiles * kTiles; }
  MapTile tile(int number, solve::Control& control) const;
  /// The tiles that are missing are pending cells.
  ParameterMap assemble(std::vector<MapTile> tiles) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

/// Where the control ends it early, what is known by then. The result does not depend on the number of threads.
ParameterMap parameter_map(const MapQuestion& question, const ParameterMapOptions& options, solve::Control& control);

/// Of a map with claims.
result::MapFile to_file(const MapQuestion& question, const ParameterMap& map);

/// A few lines for a terminal.
std::string to_table(const ParameterMap& map);
/// x_lo, x_hi, y_lo, y_hi, kind, count, at_centre in each row, after a heading; with requirements also standing.
std::string to_csv(const ParameterMap& map);
/// {"model", "set", "count", "over": {name: [lo, hi]}, "fixed", "tolerances": {name: [lo, hi]}, "resolution", "cells":
/// [[x_lo, x_hi, y_lo, y_hi, kind, count, at_centre, standing]], "boundary": [[x_lo, x_hi, y_lo, y_hi, proven]],
/// "cusps", "nodes": the same, or null, "cusps_known", "nodes_known", "aspects", "shares" …}; doc/maps.md.
std::string to_json(const ParameterMap& map);
/// For transport: a tile without its sheets as text, and back. Throws std::invalid_argument.
std::string to_json(const MapTile& tile);
MapTile tile_from_json(const std::string& text);

}  // namespace corank::analyze
