// What is drawn of aspects.
#pragma once

#include <string>
#include <vector>

#include "corank/analyze/aspects.h"
#include "corank/report/region_map.h"

namespace corank::report {

/// The first two outputs, and the first two inputs, that are not held.
std::vector<std::string> drawn_coordinates(const symbolic::Mechanism& model);

/// "1  + − +": of each aspect its number and the signs of the factors.
std::vector<std::string> aspect_labels(const analyze::Aspects& aspects);

/// The aspects in the plane of the first two of these coordinates and in that of the others. Requires aspects.drawing.
RegionMap aspects_picture(const std::string& model, const analyze::Aspects& aspects);

}  // namespace corank::report
