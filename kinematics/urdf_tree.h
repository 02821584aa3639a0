// The links and joints of a URDF document; urdf.h says what becomes of them.
#pragma once

#include "corank/kinematics/robot.h"
#include "corank/kinematics/urdf_document.h"

namespace corank::kinematics {

/// `closed`: loops will be added, so that a floating joint's link may be held by them.
Robot read_urdf_tree(const UrdfDocument& document, const std::string& file, bool closed);

}  // namespace corank::kinematics
