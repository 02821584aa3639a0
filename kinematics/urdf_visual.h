// What a URDF link looks like: its <visual> elements as shapes.
#pragma once

#include <map>

#include "corank/kinematics/urdf_reading.h"

namespace corank::kinematics {

/// Colours "#rrggbb" by the names of <material> elements of <robot>.
using UrdfColours = std::map<std::string, std::string, std::less<>>;
UrdfColours read_urdf_colours(const UrdfReading& reading);

/// Spheres, cylinders along z of their origin, boxes as six faces. Meshes and geometry without size are passed over.
void read_urdf_visual(UrdfReading& reading, const pugi::xml_node& visual, const UrdfColours& colours, Link& link);

}  // namespace corank::kinematics
