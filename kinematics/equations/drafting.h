// The steps from a robot to its draft: legs in one piece, equations in a plane or in space, what a report draws.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "corank/kinematics/equations/draft.h"
#include "corank/symbolic/sets/parameters.h"

namespace corank::kinematics {

/// Legs in one piece: universal, prismatic, universal, whose two inner axes are parallel.
///
/// Such a leg's inner axes u are perpendicular to the axis a at its first end, to the axis b at its last, and to the leg p.
/// A unit vector u with u·a = u·p = u·b = 0 exists exactly where det(a, p, b) = 0, so one equation takes the place of the
/// directions of two links: the legs of a 3-UPU robot then ask for 9 unknowns less each, and where u and −u did, one
/// configuration stands for both (doc/theory.md, "Legs in one piece").
struct LegsInOnePiece {
  Robot robot;                                  ///< a universal_rod for each such leg, by its prismatic joint's name
  std::vector<symbolic::Condition> conditions;  ///< under which the legs are such, if the robot has any
};

/// The robot with its legs in one piece where that loses nothing: both universal joints passive and without ranges, the
/// prismatic joint's range above 0, both centres on the line along which it slides, nothing else on the two links, which
/// have no shapes. The robot itself if it has further equations, which may name coordinates of such joints.
LegsInOnePiece legs_in_one_piece(const Robot& robot);

/// The plane's normal in each group's frame; nothing where the robot does not move in a plane: all turning axes have one
/// direction, all sliding ones are perpendicular to it.
std::optional<std::vector<Vec>> plane_of(const Bodies& bodies, const Algebra& algebra);

/// Writes the equations of a robot in a plane. Each group of bodies has an absolute angle, or the angle of the joint that
/// carries it; a loop closes by two equations. Velocities are the derivatives of these: L = Φ_q. Throws ModelError where the
/// robot can't be assembled, or an output means nothing in a plane.
void draft_planar(const Robot& robot, const Bodies& bodies, const std::vector<Vec>& normals, Algebra& algebra, Draft& draft);

/// Writes the equations of a robot in space.
///
/// Unknowns are directions: the axis of a turning joint is one unit vector that both of its links share. Two directions that
/// are fixed in a group of bodies (with their constant angle) make its rotation; the third is their cross product, and all
/// others are combinations of the three. Positions are eliminated through a spanning tree; a loop closes by three equations
/// between directions, a rod by one. So there are as many equations as coordinates, less the mobility.
///
/// Velocities are twists (Davies 1981; Zlatanov, Fenton, Benhabib 1994): a loop's rates times its screws add up to zero;
/// rows that can never hold anything are left out. Where two rods are taken together (rods.h) and all inputs and outputs
/// are coordinates, velocities are those of the equations.
///
/// Returns whether the robot is a spherical one: all of its loops close wherever its bodies are turned to, since all axes go
/// through one point. `deep`: of the spanning tree. Throws ModelError where the robot can't be assembled.
bool draft_spatial(const Robot& robot, const Bodies& bodies, Algebra& algebra, Draft& draft, bool deep = false);

/// A point in the picture's coordinates, and its velocity in the rates where the mechanism has such.
struct Motion {
  Vec at;
  std::optional<Vec> velocity;
};

/// What a report draws of a robot, in the plane or in space: its links between their joints, its shapes; points move as the
/// rates say. `place` is where a body's point is.
void draw(const Drafter& drafter, Space space, const std::function<Motion(std::size_t body, const Vec& point)>& place);

}  // namespace corank::kinematics
