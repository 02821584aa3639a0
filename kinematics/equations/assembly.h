// From a robot's parts to its equations.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "corank/kinematics/robot/robot.h"
#include "corank/symbolic/sets/left_out.h"
#include "corank/symbolic/sets/parameters.h"

namespace corank::kinematics {

/// Where a robot moves: in a plane, about a point, or in space.
enum class Space { planar, spherical, spatial };

const char* to_string(Space space);

struct Assembly {
  /// x ↦ R x + p of a link's frame in the world, in the mechanism's coordinates.
  struct LinkPose {
    std::string link;
    Vector origin;
    std::array<Vector, 3> rotation;
  };
  /// The coordinate of a joint; or, where its angle is none, the angle's cosine and sine.
  struct JointValue {
    std::string joint;
    Expression value;
    std::optional<Expression> sine;
  };

  std::shared_ptr<const Robot> robot;  ///< of which it was made
  symbolic::Mechanism
      mechanism;  ///< coordinates and equations; velocity equation, inputs and outputs where the robot has such
  Space space = Space::spatial;
  int mobility = 0;  ///< coordinates less equations
  /// What the count says of a robot whose parts are given: 3 (in space 6) for each body but the ground, less what each joint
  /// takes away (Chebychev, Grübler, Kutzbach).
  int mobility_by_joints = 0;
  /// At a configuration that was found by sampling; nothing where none was found. It proves nothing.
  std::optional<int> mobility_by_rank;
  /// Parallelograms that are written out and not kept (loop_branches.h).
  struct WrittenParallelogram {
    std::vector<std::string> sides;  ///< their names
    std::string angle;               ///< the coordinate that tells how it closes; none where its ways are not told apart
    bool is_rhombus = false;         ///< 0: a parallelogram, pi: crosswise; of a rhombus pi/2 and pi
  };
  std::vector<WrittenParallelogram> parallelograms;
  bool has_universal_rods = false;       ///< of one equation and a length each (drafting.h)
  std::size_t links = 0;                 ///< of the robot
  std::vector<LinkPose> poses;           ///< of every link, except those of legs in one piece (drafting.h)
  std::vector<JointValue> joint_values;  ///< of every joint that has one value
  /// Where these hold, the robot has these equations for other values of its constants, too. Theorem: whatever was decided
  /// while they were made, was decided by the sign of one of these expressions, so that the same decisions make the same
  /// equations, in which the constants stand by name.
  std::vector<symbolic::Condition> conditions;
  std::vector<symbolic::LeftOut> left_out{};  ///< by exact identities (identities.h), or as repetitions
};

/// The equations of a robot. Throws ModelError where the robot is faulty or can't be assembled; where it has no
/// coordinates, or more than 500 moving bodies.
Assembly assemble(const Robot& robot);

/// How many of a system's equations follow from the others, to first order, at solutions within its ranges, found from
/// random points (of fixed seeds): their number less their Jacobian's rank. Where none of the tries ends in one,
/// 0 if a solution outside shows it, else nothing; nothing either where the variables are hundreds.
std::optional<int> sampled_redundancy(const System& system);

}  // namespace corank::kinematics
