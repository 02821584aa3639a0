// Joints that follow other joints: what all of their angles are multiples of.
#pragma once

#include <optional>
#include <vector>

#include "corank/kinematics/robot/algebra.h"

namespace corank::kinematics {

/// Angles of joints that turn together are rational multiples of the first driver's, so whole multiples of one n-th of it,
/// n the least common denominator. That n-th, t, is their coordinate: as (t m₁ + c₁, t m₂ + c₂ …) with multiples without a
/// common divisor runs once through all positions when t runs once through the circle, no position is lost or counted
/// twice. Ways of joints that slide together are multiples of the first driver's, whatever the ratio.
class Couplings {
 public:
  /// Throws ModelError where a ratio of angles is not rational, or its numbers are too large to turn so often.
  Couplings(const Robot& robot, const Algebra& algebra);

  /// Where a joint is in its train: value = multiple · coordinate + offset.
  struct Place {
    std::size_t train = 0;
    ex multiple = 1, offset = 0;
  };
  struct Train {
    std::size_t driver = 0;  ///< the first
    int parts = 1;           ///< the coordinate is the driver's angle divided by this
    std::vector<std::size_t> joints;
  };
  const std::optional<Place>& of(std::size_t joint) const { return places_[joint]; }
  const std::vector<Train>& trains() const { return trains_; }

  /// The largest multiple of an angle: of this degree are the equations.
  static constexpr int kMostTurns = 24;

 private:
  std::vector<std::optional<Place>> places_;  // of each joint of the robot
  std::vector<Train> trains_;
};

}  // namespace corank::kinematics
