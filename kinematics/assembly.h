// From a robot's parts to its equations.
#pragma once

#include <optional>
#include <string>

#include "corank/kinematics/robot.h"

namespace corank::kinematics {

struct Assembly {
  symbolic::Mechanism
      mechanism;  ///< coordinates and equations; velocity equation, inputs and outputs where the robot has such
  bool is_planar = false;
  int mobility = 0;  ///< coordinates less equations
  /// What the count says of a robot whose parts are given: 3 (or, in space, 6) for each body but the ground, less what each
  /// joint takes away (Chebychev, Grübler, Kutzbach).
  int mobility_by_joints = 0;
  /// At a configuration that was found by sampling; nothing where none was found. It proves nothing.
  std::optional<int> mobility_by_rank;
};

/// The equations of a robot. Throws ModelError where the robot is faulty or can't be assembled; where it has no coordinates.
Assembly assemble(const Robot& robot);

/// The mobility of a mechanism at a configuration found by Newton's method from random ones (of fixed seeds): its coordinates
/// less the rank of Φ_q. Nothing where none of the tries ends in a configuration.
std::optional<int> sampled_mobility(const symbolic::Mechanism& mechanism);

}  // namespace corank::kinematics
