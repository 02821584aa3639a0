// Robots in a plane: all turning axes have one direction, all sliding ones are perpendicular to it.
//
// Each group of bodies has an absolute angle, or the angle of the joint that carries it; a loop closes by two equations.
// Velocities are the derivatives of these: L = Φ_q.
#pragma once

#include <optional>
#include <vector>

#include "corank/kinematics/bodies.h"
#include "corank/kinematics/draft.h"

namespace corank::kinematics {

/// The plane's normal in each group's frame; nothing where the robot does not move in a plane.
std::optional<std::vector<Vec>> plane_of(const Bodies& bodies, const Algebra& algebra);

/// Throws ModelError where the robot can't be assembled, or an output means nothing in a plane.
void draft_planar(const Robot& robot, const Bodies& bodies, const std::vector<Vec>& normals, Algebra& algebra, Draft& draft);

}  // namespace corank::kinematics
