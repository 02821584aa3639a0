#include <algorithm>
#include <optional>

#include "corank/kinematics/equations/drafting.h"
#include "corank/kinematics/loops/bodies.h"

namespace corank::kinematics {
namespace {

class Legs {
 public:
  explicit Legs(const Robot& robot) : robot_(robot), algebra_(robot), bodies_(bodies_of(robot, algebra_)) {
    at_body_.resize(bodies_.size());
    for (std::size_t k = 0; k < bodies_.joints.size(); ++k)
      for (const BodyEnd& end : bodies_.joints[k].ends) at_body_[end.body].push_back(k);
  }

  LegsInOnePiece run() {
    LegsInOnePiece result{robot_, {}};
    std::vector<bool> goes(bodies_.size(), false);
    std::vector<std::optional<Joint>> legs(robot_.joints.size());
    for (const BodyJoint& slide : bodies_.joints) {
      legs[slide.index] = leg(slide);
      if (legs[slide.index])
        for (const BodyEnd& end : slide.ends) goes[end.body] = true;
    }
    if (std::ranges::none_of(legs, [](const auto& leg) { return leg.has_value(); })) return result;
    result.conditions = conditions_of(robot_, bodies_, algebra_);
    leave(result.robot, goes, legs);
    return result;
  }

 private:
  /// The universal joint that is all that a body of a leg has beside its sliding joint: its place in Bodies::joints.
  std::optional<std::size_t> universal_at(std::size_t body) const {
    if (body == 0 || at_body_[body].size() != 2) return std::nullopt;
    for (const std::size_t k : at_body_[body]) {
      const BodyJoint& j = bodies_.joints[k];
      const Joint& of = robot_.joints[j.index];
      if (j.kind == JointKind::universal && of.ranges.empty() && !robot_.is_asked_for(j.index)) return k;
    }
    return std::nullopt;
  }

  /// Nobody asks where the body is, or draws it.
  bool is_plain(std::size_t body) const { return !bodies_.has_shapes(robot_, body) && !bodies_.has_output(robot_, body); }

  std::optional<Joint> leg(const BodyJoint& slide) const {
    const Joint& of = robot_.joints[slide.index];
    if (slide.kind != JointKind::prismatic || robot_.is_coupled(slide.index) || !of.range()) return std::nullopt;
    Joint leg = of;
    leg.kind = JointKind::universal_rod;
    std::array<Vec, 2> inner, apart;
    std::array<std::size_t, 2> beyond;
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
      const BodyEnd& own = slide.ends[i];
      const auto k = universal_at(own.body);
      if (!k || !is_plain(own.body)) return std::nullopt;
      const BodyJoint& joint = bodies_.joints[*k];
      const std::size_t near = joint.ends[0].body == own.body ? 0 : 1;
      inner[i] = joint.ends[near].axis;
      apart[i] = algebra_.clean(joint.ends[near].point - own.point);
      beyond[i] = joint.ends[1 - near].body;
      leg.ends[i] = robot_.joints[joint.index].ends[1 - near];
    }
    // The length is the joint's displacement: each centre is where the sliding joint has its point.
    if (beyond[0] == beyond[1] || algebra_.sign(algebra_.constant(of.ranges[0]->lower, of.where)) <= 0 ||
        !algebra_.is_zero(apart[0]) || !algebra_.is_zero(apart[1]) || !algebra_.are_parallel(inner[0], inner[1]) ||
        !algebra_.is_zero(algebra_.clean(dot(inner[0], slide.ends[0].axis))))
      return std::nullopt;
    return leg;
  }

  /// The robot without the bodies that go, and with the legs.
  void leave(Robot& robot, const std::vector<bool>& goes, const std::vector<std::optional<Joint>>& legs) const {
    std::vector<std::size_t> link(robot_.links.size()), joint(robot_.joints.size());  // new places
    robot.links.clear();
    for (std::size_t l = 0; l < link.size(); ++l) {
      link[l] = robot.links.size();
      if (!goes[bodies_.of_link[l]]) robot.links.push_back(robot_.links[l]);
    }
    robot.joints.clear();
    for (std::size_t j = 0; j < joint.size(); ++j) {
      joint[j] = robot.joints.size();
      const bool stays =
          std::ranges::none_of(robot_.joints[j].ends, [&](const JointEnd& end) { return goes[bodies_.of_link[end.link]]; });
      if (!stays && !legs[j]) continue;
      Joint& left = robot.joints.emplace_back(legs[j] ? *legs[j] : robot_.joints[j]);
      for (JointEnd& end : left.ends) end.link = link[end.link];
    }
    for (Coupling& c : robot.couplings) c.driver = joint[c.driver], c.follower = joint[c.follower];
    for (Output& o : robot.outputs) {
      o.link = link[o.link], o.relative_to = link[o.relative_to];
      if (o.kind == Output::Kind::joint) o.joint = joint[o.joint];
    }
  }

  const Robot& robot_;
  Algebra algebra_;
  const Bodies bodies_;
  std::vector<std::vector<std::size_t>> at_body_;  // of Bodies::joints
};

}  // namespace

LegsInOnePiece legs_in_one_piece(const Robot& robot) {
  const auto count = [&](JointKind kind) {
    return std::ranges::count_if(robot.joints, [&](const Joint& j) { return j.kind == kind; });
  };
  if (!robot.equations.empty() || count(JointKind::prismatic) == 0 || count(JointKind::universal) < 2) return {robot, {}};
  return Legs(robot).run();
}

}  // namespace corank::kinematics
