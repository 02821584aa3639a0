// A drawing as SVG: text stays text, a shape is one path of whole numbers.
#pragma once

#include <string>

#include "corank/report/drawing.h"

namespace corank::report {

std::string to_svg(const Drawing& drawing, const std::string& title);

}  // namespace corank::report
