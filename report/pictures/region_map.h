// Regions of planes, a small panel for each, as SVG: where the pieces of a set are that lie over one another.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "corank/core/interval.h"

namespace corank::report {

struct RegionMap {
  using Polygon = std::vector<std::array<double, 2>>;
  struct Plane {
    std::string x_name, y_name;
    bool x_angle = false, y_angle = false;      ///< shown from −π to π; polygons go on at the other end
    std::vector<std::vector<Polygon>> regions;  ///< as many for each plane
  };
  std::string title;
  std::vector<std::string> labels;  ///< of the regions
  std::vector<Plane> planes;
};

/// "#0072b2": of region `k`. Apart from each other in hue and lightness, also for most of the colour-blind; after twelve
/// they begin again.
const char* region_color(std::size_t k);

std::string to_svg(const RegionMap& map);

}  // namespace corank::report
