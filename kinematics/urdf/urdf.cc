#include "corank/kinematics/urdf/urdf.h"

#include <algorithm>

#include "corank/kinematics/language/part_file.h"
#include "corank/kinematics/urdf/urdf_reading.h"

namespace corank::kinematics {
namespace {

// The companion's inputs stand for those of the transmissions, where it has some.
void add_loops(Robot& robot, const UrdfLoops& loops) {
  std::vector<std::size_t> driven;
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    if (robot.joints[i].actuated) driven.push_back(i);
    robot.joints[i].actuated = false;
  }
  parse_more(robot, loops.text, loops.file);
  if (std::ranges::any_of(robot.joints, [](const Joint& joint) { return joint.actuated; })) return;
  for (const std::size_t i : driven) robot.joints[i].actuated = true;
}

}  // namespace

Robot parse_urdf(std::string_view text, const std::string& file, const std::optional<UrdfLoops>& loops) {
  Robot robot = read_urdf_tree(text, file, loops.has_value());
  if (loops) add_loops(robot, *loops);
  if (std::ranges::none_of(robot.joints, [](const Joint& joint) { return joint.actuated; }))
    robot.notices.push_back("no <transmission> says which joints are actuated; list them in [INPUTS] of a .loops file");
  robot.validate();
  return robot;
}

}  // namespace corank::kinematics
