// Legs in one piece: universal, prismatic, universal, whose two inner axes are parallel.
//
// Such a leg's inner axes u are perpendicular to the axis a at its first end, to the axis b at its last, and to the leg p.
// A unit vector u with u·a = u·p = u·b = 0 exists exactly where det(a, p, b) = 0, so one equation takes the place of the
// directions of two links: the legs of a 3-UPU robot then ask for 9 unknowns less each, and where u and −u did, one
// configuration stands for both (doc/theory.md, "Legs in one piece").
#pragma once

#include "corank/kinematics/robot.h"
#include "corank/symbolic/parameters.h"

namespace corank::kinematics {

struct LegsInOnePiece {
  Robot robot;                                  ///< a universal_rod for each such leg, by its prismatic joint's name
  std::vector<symbolic::Condition> conditions;  ///< under which the legs are such, if the robot has any
};

/// The robot with its legs in one piece where that loses nothing: both universal joints passive and without ranges, the
/// prismatic joint's range above 0, both centres on the line along which it slides, nothing else on the two links, which
/// have no shapes. The robot itself if it has further equations, which may name coordinates of such joints.
LegsInOnePiece legs_in_one_piece(const Robot& robot);

}  // namespace corank::kinematics
