// A drawing as SVG: text stays text, a shape is one path of whole numbers.
#pragma once

#include <string>
#include <vector>

#include "corank/report/drawing.h"

namespace corank::report {

std::string to_svg(const Drawing& drawing, const std::string& title);

/// Several on one page, each with its upper left corner at (x, y).
struct PlacedDrawing {
  double x = 0, y = 0;
  Drawing drawing;
};
std::string to_svg(const std::vector<PlacedDrawing>& drawings, const std::string& title);

}  // namespace corank::report
