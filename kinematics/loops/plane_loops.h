// Loops of a robot in space all of whose axes are parallel, with rods between their bodies: a parallelogram on a turning
// column, say. Whatever carries them, they close in a plane of their own, by two equations and no condition on directions;
// in space the same loop would have six, three of which say nothing and hide the robot's mobility.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "corank/kinematics/loops/plane.h"

namespace corank::kinematics {

/// Loops with one direction of axes that hang together. Frames and SpatialRobot fill in how its bodies lie, from the one
/// that carries the others.
struct PlanePart : Plane {
  struct Rate {
    std::size_t joint;  ///< in Bodies::joints
    int sign;
  };
  std::optional<std::size_t> root{};   ///< the body that carries the others: it has the plane
  std::optional<Vec> normal{};         ///< in the world
  std::set<std::size_t> reached{};     ///< bodies, within the part
  std::map<std::size_t, ex> angles{};  ///< of each group whose angle from the root is a coordinate of its own
  std::map<std::size_t, std::vector<Rate>> turning{};  ///< of each group from the root: the sum of these joints' rates
  std::set<std::size_t> following{};                   ///< joints of the tree between groups that others turn already
  /// Of each joint that closes a loop what its equations set to 0: the gap's two components, or half of a rod's square.
  std::map<std::size_t, std::vector<ex>> closings{};
};

class PlaneLoops {
 public:
  PlaneLoops(const Bodies& bodies, const Algebra& algebra);

  bool has(std::size_t joint) const { return part_of_[joint].has_value(); }
  /// Nothing where the joint, by its index in Bodies::joints, is in no loop of this sort.
  PlanePart* of(std::size_t joint) { return has(joint) ? &parts_[*part_of_[joint]] : nullptr; }
  /// The part in whose plane a joint closes a loop.
  PlanePart* closing(std::size_t joint);

 private:
  const Bodies& bodies_;
  std::vector<PlanePart> parts_;
  std::vector<std::optional<std::size_t>> part_of_;
};

}  // namespace corank::kinematics
