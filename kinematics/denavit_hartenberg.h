// The rows by which data sheets give an arm: four numbers for each joint, after Denavit and Hartenberg, "A kinematic
// notation for lower-pair mechanisms based on matrices", 1955 (key Denavit1955).
#pragma once

#include "corank/kinematics/robot.h"

namespace corank::kinematics {

enum class DhConvention {
  standard,  ///< a row is Rz(theta) Tz(d) Tx(a) Rx(alpha): its frame stands at the link's far end
  modified   ///< a row is Rx(alpha) Tx(a) Rz(theta) Tz(d) (Craig): its frame stands on the joint's axis
};

/// Of one joint: `theta` and `d` where the joint's own coordinate is 0.
struct DhRow {
  Expression a = 0, alpha = 0, d = 0, theta = 0;
};

/// The row's frame in that of the row before it, the joint at 0.
Pose dh_pose(DhConvention convention, const DhRow& row);

/// The joint's ends in the frames of the row before it and of the row: its axis is z, or −z for a negative sense, and its
/// coordinate counts from where dh_pose() has the frames.
std::array<JointEnd, 2> dh_ends(DhConvention convention, const DhRow& row, int sense);

}  // namespace corank::kinematics
