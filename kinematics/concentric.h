// Loops that turn about one point.
#pragma once

#include "corank/kinematics/bodies.h"

namespace corank::kinematics {

/// The same robot: in loops of turning joints (revolute, universal, spherical) whose axes all go through one point, each
/// joint's points are moved along its axis to that point, wherever on the axis they are given. Such loops close wherever
/// their bodies are turned to, and then they do so term by term. Loops that share a joint are looked at together.
///
/// A revolute joint asks that a line of one body, with a point on it, lies on that of the other: moving both points along by
/// the same way asks for the same.
Bodies about_centres(const Robot& robot, const Bodies& bodies, Algebra& algebra);

}  // namespace corank::kinematics
