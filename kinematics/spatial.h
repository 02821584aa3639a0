// Robots in space.
//
// Unknowns are directions: the axis of a turning joint is one unit vector that both of its links share. Two directions that
// are fixed in a group of bodies (with their constant angle) make its rotation; the third is their cross product, and all
// others are combinations of the three. Positions are eliminated through a spanning tree; a loop closes by three equations
// between directions, a rod by one. So there are as many equations as coordinates, less the mobility.
//
// Velocities are twists (Davies 1981; Zlatanov, Fenton, Benhabib 1994): a loop's rates times its screws add up to zero; rows
// that can never hold anything are left out. Where two rods are taken together (rods.h) and all inputs and outputs are
// coordinates, velocities are those of the equations.
#pragma once

#include "corank/kinematics/bodies.h"
#include "corank/kinematics/draft.h"

namespace corank::kinematics {

/// Whether it is a spherical one: all of its loops close wherever its bodies are turned to, since all axes go through one
/// point. `deep`: of the spanning tree. Throws ModelError where the robot can't be assembled.
bool draft_spatial(const Robot& robot, const Bodies& bodies, Algebra& algebra, Draft& draft, bool deep = false);

}  // namespace corank::kinematics
