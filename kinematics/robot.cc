#include "corank/kinematics/robot.h"

#include <algorithm>

namespace corank::kinematics {
namespace {

template <typename Named>
int find(const std::vector<Named>& list, const std::string& name) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const Named& item) { return item.name == name; });
  return found == list.end() ? -1 : static_cast<int>(found - list.begin());
}

}  // namespace

const char* to_string(JointKind kind) {
  switch (kind) {
    case JointKind::revolute: return "revolute";
    case JointKind::prismatic: return "prismatic";
    case JointKind::cylindrical: return "cylindrical";
    case JointKind::universal: return "universal";
    case JointKind::spherical: return "spherical";
    case JointKind::planar: return "planar";
    case JointKind::parallelogram: return "parallelogram";
    case JointKind::fixed: return "fix";
    case JointKind::distance: return "sph_sph";
    case JointKind::distance_variable: return "sph_prs_sph";
    case JointKind::universal_rod: return "uni_prs_uni";
  }
  return "?";
}

int Robot::find_link(const std::string& link) const { return find(links, link); }
int Robot::find_joint(const std::string& joint) const { return find(joints, joint); }

std::size_t Robot::link(const std::string& link_name) {
  const int index = find_link(link_name);
  if (index >= 0) return index;
  links.push_back({link_name, {}, {}});
  return links.size() - 1;
}

Joint& Robot::join(JointKind kind, const std::string& joint_name, const std::string& first, const Vector& point,
                   const Vector& axis, const std::string& second, const Vector& second_point, const Vector& second_axis) {
  Joint joint;
  joint.name = joint_name;
  joint.kind = kind;
  joint.ends = {JointEnd{link(first), point, axis, {}}, JointEnd{link(second), second_point, second_axis, {}}};
  joint.is_named = true;
  return joints.emplace_back(std::move(joint));
}

Joint& Robot::revolute(const std::string& joint_name, const std::string& first, const Vector& point, const Vector& axis,
                       const std::string& second, const Vector& second_point, const Vector& second_axis) {
  return join(JointKind::revolute, joint_name, first, point, axis, second, second_point, second_axis);
}

Joint& Robot::rod(const std::string& joint_name, const std::string& first, const Vector& point, const std::string& second,
                  const Vector& second_point, const std::optional<Expression>& length) {
  Joint& joint = join(length ? JointKind::distance : JointKind::distance_variable, joint_name, first, point, {0, 0, 0},
                      second, second_point, {0, 0, 0});
  if (length) joint.length = *length;
  return joint;
}

Joint& Robot::fix(const std::string& first, const std::string& second, const Pose& pose) {
  Joint& joint = join(JointKind::fixed, first + "_" + second, first, {0, 0, 0}, {0, 0, 0}, second, {0, 0, 0}, {0, 0, 0});
  joint.pose = pose;
  return joint;
}

}  // namespace corank::kinematics
