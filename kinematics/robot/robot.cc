#include "corank/kinematics/robot/robot.h"

#include <algorithm>

#include "corank/kinematics/robot/vectors.h"

namespace corank::kinematics {
namespace {

template <typename Named>
int find(const std::vector<Named>& list, const std::string& name) {
  const auto found = std::ranges::find_if(list, [&](const Named& item) { return item.name == name; });
  return found == list.end() ? -1 : static_cast<int>(found - list.begin());
}

}  // namespace

std::span<const JointTraits> joint_traits() {
  using enum JointKind;
  static constexpr std::array<JointTraits, 12> kTraits{{{revolute, "revolute", 1, 1, true, true},
                                                        {prismatic, "prismatic", 1, 1, true},
                                                        {cylindrical, "cylindrical", 2, 2, true, true},
                                                        {universal, "universal", 2, 2, true, true},
                                                        {spherical, "spherical", 3, 1},
                                                        {slot, "slot", 4, 1, true},
                                                        {planar, "planar", 3, 0, true},
                                                        {parallelogram, "parallelogram", 1, 1, true, true},
                                                        {fixed, "fix", 0},
                                                        {distance, "sph_sph", 5},
                                                        {distance_variable, "sph_prs_sph", 6, 1},
                                                        {universal_rod, "uni_prs_uni", 5, 1, true}}};
  return kTraits;
}

const JointTraits& traits(JointKind kind) { return *std::ranges::find(joint_traits(), kind, &JointTraits::kind); }

std::vector<std::string> kind_names(bool with_coordinate) {
  std::vector<std::string> names;
  for (const JointTraits& known : joint_traits())
    if (!with_coordinate || has_coordinate(known.kind)) names.emplace_back(known.name);
  return names;
}

bool Robot::is_coupled(std::size_t joint) const {
  return std::ranges::any_of(couplings, [&](const Coupling& c) { return c.driver == joint || c.follower == joint; });
}

bool Robot::is_output(std::size_t joint) const {
  return std::ranges::any_of(outputs, [&](const Output& o) { return o.kind == Output::Kind::joint && o.joint == joint; });
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

namespace {

Vector unit(const Vector& v) {
  const Expression square = dot(v, v);
  if (is_literal_one(square)) return v;
  const Expression length = symbolic::sqrt(square);
  return {v[0] / length, v[1] / length, v[2] / length};
}

// One that is perpendicular to it; nothing where that takes more than a look.
std::optional<Vector> zero_of(const Vector& axis) {
  for (std::size_t i = 0; i < 3; ++i)
    if (is_literal_zero(axis[(i + 1) % 3]) && is_literal_zero(axis[(i + 2) % 3])) {
      Vector zero{0, 0, 0};
      zero[(i + 1) % 3] = 1;
      return zero;
    }
  return std::nullopt;
}

// With the axis as z and the zero as x, in the frame of the end's link.
Pose frame_of(const JointEnd& end, const Vector& zero) {
  const Vector z = unit(end.axis);
  const Expression height = dot(zero, z);
  const Vector along{folded_product(height, z[0]), folded_product(height, z[1]), folded_product(height, z[2])};
  const Vector x = unit(zero - along), y = cross(z, x);
  Pose frame;
  for (std::size_t i = 0; i < 3; ++i) frame.rotation[i] = {x[i], y[i], z[i]};
  frame.translation = end.point;
  return frame;
}

}  // namespace

bool Robot::lock(std::size_t index, const Expression& value) {
  Joint& joint = joints[index];
  const bool turns = joint.kind == JointKind::revolute;
  if ((!turns && joint.kind != JointKind::prismatic) || is_coupled(index) || is_output(index)) return false;
  std::array<std::optional<Vector>, 2> zeros{joint.ends[0].zero, joint.ends[1].zero};
  if (!zeros[0] || !zeros[1]) {  // then the axes are the same in both frames
    for (std::size_t i = 0; i < 3; ++i)
      if (!symbolic::same_tree(joint.ends[0].axis[i], joint.ends[1].axis[i])) return false;
    zeros[0] = zeros[1] = zero_of(joint.ends[0].axis);
    if (!zeros[0]) return false;
  }
  const Pose moved = turns ? rotation(2, value) : translation({0, 0, value});
  joint.pose = frame_of(joint.ends[0], *zeros[0]) * moved * inverse(frame_of(joint.ends[1], *zeros[1]));
  joint.kind = JointKind::fixed;
  joint.ranges.clear();
  joint.actuated = false;
  return true;
}

}  // namespace corank::kinematics
