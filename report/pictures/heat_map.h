// A quantity over a grid as colours from dark to bright, with a scale, as SVG.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corank/core/interval.h"

namespace corank::report {

struct HeatMap {
  struct Cell {
    Interval x, y;
    double value;
  };
  std::string title, x_name, y_name, value_name;
  Interval x_range, y_range;
  std::vector<Cell> cells;  ///< what is not covered stays white
  struct Mark {
    double x, y;
    std::string label;
  };
  std::optional<Mark> mark;  ///< a cross, and its word below the picture
};

std::string to_svg(const HeatMap& map);

}  // namespace corank::report
