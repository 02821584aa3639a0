// Parallelograms that are written out: four bodies, or three and a rod, that turn on each other about parallel axes,
// opposite sides of one length. Such a loop closes in two ways, as a parallelogram and crosswise, as an antiparallelogram.
// Both meet where it is flat: there C-space has branches that cross, and no box about them can be certified.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "corank/kinematics/loops/bodies.h"

namespace corank::kinematics {

/// Two links that a parallelogram keeps as they are turned to each other: x₀ = R x₁ + …
struct KeptRotation {
  std::size_t first = 0, second = 0;  ///< in Robot::links
  Mat rotation;
};

/// From hinge to hinge: a vector of a body, or a rod.
struct SideWay {
  std::optional<std::size_t> body, rod;  ///< in Bodies, in Bodies::joints
  Vec way;                               ///< in the body's frame, across the axes
};

struct Parallelogram {
  std::vector<std::string> sides;  ///< names of links, and of the rod, in their order around
  std::array<SideWay, 4> ways;     ///< A, B, C, D with A + B = C + D, of these sides in another order: A and C are opposite
  std::vector<ex> differences;     ///< of squares of lengths, which are 0: |A|² − |C|², |B|² − |D|²
  std::vector<KeptRotation> opposite;  ///< of each pair of opposite sides that are no rods
};

/// The loops in which opposite sides are of one length, by the exact geometry. `bodies` has nothing kept in it.
std::vector<Parallelogram> parallelograms_of(const Robot& robot, const Bodies& bodies, const Algebra& algebra);

}  // namespace corank::kinematics
