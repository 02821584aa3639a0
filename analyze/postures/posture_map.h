// How many postures an arm of six revolute joints has over a plane of its hand's positions, at one orientation.
#pragma once

#include <vector>

#include "corank/analyze/maps/parameter_map.h"
#include "corank/analyze/postures/postures.h"

namespace corank::analyze {

/// A map's question: the parameters are two of the three components of the hand's position, `fixed` says where the third
/// is. It is about a plain system, whose solutions are the arm's postures, one for each: theorem in
/// kinematics/equations/six_joints.h. Throws ModelError as PostureFinder does, and for other robots.
MapQuestion posture_map(const study::Question& robot, std::vector<symbolic::Parameter> over,
                        const std::vector<symbolic::FixedCoordinate>& fixed, const Rotation& orientation,
                        const std::string& orientation_of);

}  // namespace corank::analyze
