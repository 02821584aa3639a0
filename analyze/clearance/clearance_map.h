// The clearance over a grid of centres, with bounds for each cell of it: those of the cell's middle, less and plus its half
// diagonal (center_field.h).
#pragma once

#include <functional>

#include "corank/analyze/clearance/center_field.h"

namespace corank::analyze {

struct MapCell {
  enum class Robot { assembled, not_in_middle, nowhere };  ///< where a configuration is proven; nowhere: proven that none is

  Box sides;
  std::vector<double> middle;
  Robot robot = Robot::not_in_middle;
  double lower = 0;             ///< of the middle
  std::optional<double> upper;  ///< likewise; nothing: no bound is proven
  double cell_lower = 0;        ///< of all centres in the cell
  std::optional<double> cell_upper;
};

struct ClearanceMap {
  Ball ball;
  std::vector<std::string> names;  ///< two
  Box region;
  int grid = 0;                ///< cells along each side
  std::vector<MapCell> cells;  ///< row by row, the second coordinate ascending; those that were examined
  bool empty = false;          ///< proven: no singularity at all in the ranges
  bool complete = false;       ///< every cell was examined
  std::string stopped;         ///< what ended it early; empty: nothing
  double precision = 0.01, seconds = 0;
  std::uint64_t processed = 0;

  /// The assembled middle of the largest lower bound; nothing where none is.
  const MapCell* best() const;
};

struct MapOptions {
  int grid = 24;
  double precision = 0.01;  ///< of the radius at each middle
  std::function<void(std::size_t done, std::size_t all)> progress{};
};

/// `region`: two coordinates. Throws ModelError.
ClearanceMap clearance_map(const study::Question& question, const BallOptions& ball, const std::vector<NamedRange>& region,
                           const MapOptions& options, const solve::Options& search, solve::Control& control);

/// x, y, robot, lo, hi, cell_lo, cell_hi in each row, after a heading; empty: not known.
std::string to_csv(const ClearanceMap& map);
/// {"model", "set", "in", "region", "grid", "empty", "complete", "stopped", "precision", "best", "cells": [rows of the
/// table], "processed", "seconds"}.
std::string to_json(const ClearanceMap& map);

}  // namespace corank::analyze
