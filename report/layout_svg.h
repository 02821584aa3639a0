// A layout as SVG: text stays text, a shape is one path of whole numbers.
#pragma once

#include <string>
#include <vector>

#include "corank/report/layout.h"

namespace corank::report {

std::string to_svg(const Layout& drawing, const std::string& title);

/// Several on one page, each with its upper left corner at (x, y).
struct PlacedDrawing {
  double x = 0, y = 0;
  Layout drawing;
};
std::string to_svg(const std::vector<PlacedDrawing>& drawings, const std::string& title);

}  // namespace corank::report
