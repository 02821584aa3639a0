// The velocity equation of a spatial robot, by twists: rates of the joints, and of bodies that only rods carry; rows for each
// joint that closes a loop and for each rod.
//
//   Σ_k ω_k a_k = 0 and Σ_k ω_k a_k × (c − c_k) + v_k a_k = 0 over a loop's joints; (p₁ − p₀)·(v₁ − v₀) = l l̇ of a rod.
//
// Davies, "Kirchhoff's circulation law applied to multi-loop kinematic chains", 1981 (key Davies1981). The rows are the
// derivatives of the loop's conditions along a motion, written in independent rates: at every configuration they have the
// same feasible motions as Φ_q, so both forms name the same singular configurations (doc/theory.md).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "corank/kinematics/frames.h"

namespace corank::kinematics {

/// Where things are, in the world.
struct Positions {
  std::vector<std::optional<Vec>> origins;    ///< of each body's frame
  std::vector<std::optional<ex>> coordinate;  ///< of each joint of the robot: its angle, way or length
  std::map<std::string, Vec> output_points;   ///< by the output's name
};

void draft_twists(const Robot& robot, const Bodies& bodies, const SpanningTree& tree, Frames& frames,
                  const Positions& positions, Algebra& algebra, Draft& draft);

}  // namespace corank::kinematics
