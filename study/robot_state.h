// What a solution means for the robot: values of its joints, poses of its links.
#pragma once

#include "corank/kinematics/assembly.h"
#include "corank/result/result.h"

namespace corank::study {

/// Sets Result::states, one for each point of a set of dimension 0.
void describe_states(const kinematics::Assembly& assembly, result::Result& result);

}  // namespace corank::study
