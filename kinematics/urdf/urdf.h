// URDF, the robot format of ROS, as a Robot: a tree of links, whose root is the ground, and joints. doc/urdf.md describes it
// for users.
//
// URDF can close no loops and names no outputs: a companion file in the parts language does (robot.loops).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "corank/kinematics/robot/robot.h"

namespace corank::kinematics {

/// The text of a companion, which parse_more() (part_file.h) reads, and the name that messages show.
struct UrdfLoops {
  std::string text, file;
};

/// Reads a URDF text. `file` is the name that messages show.
///
/// Numbers are exact as written, but for angles that are decimals of a multiple of pi (urdf_number.h): those become that
/// multiple, and a notice says so. Lengths are in metres. The root link comes first; a joint's end 0 is on its parent, at
/// xyz, with the axis R·axis, end 1 on its child, whose frame is the joint's: the angle between the ends' zeros is URDF's.
///
/// Joints: revolute, continuous, prismatic, fixed, planar; floating is no joint where loops hold the link, else refused;
/// mimic is a coupling. Limits are ranges. A joint is actuated where a <transmission>, or a <ros2_control> with a command
/// interface, names it, unless the loops' [INPUTS] name others. Spheres, cylinders and boxes of <visual> are shapes; what is
/// passed over is in the notices. Names that are no identifiers are changed, with a notice.
///
/// Throws ModelError with file, line and column at the first fault, and for what Robot::validate() refuses; never crashes,
/// whatever the text.
Robot parse_urdf(std::string_view text, const std::string& file, const std::optional<UrdfLoops>& loops = {});

}  // namespace corank::kinematics
