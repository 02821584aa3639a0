#include "corank/kinematics/dyads.h"

#include <algorithm>

namespace corank::kinematics {
namespace {

/// Neither driven nor asked for.
bool is_passive_revolute(const Robot& robot, const BodyJoint& j) {
  return j.kind == JointKind::revolute && !robot.joints[j.index].actuated &&
         std::none_of(robot.couplings.begin(), robot.couplings.end(),
                      [&](const Coupling& c) { return c.driver == j.index || c.follower == j.index; }) &&
         std::none_of(robot.outputs.begin(), robot.outputs.end(),
                      [&](const Output& o) { return o.kind == Output::Kind::joint && o.joint == j.index; });
}

bool has_output(const Robot& robot, const Bodies& bodies, std::size_t body) {
  return std::any_of(robot.outputs.begin(), robot.outputs.end(), [&](const Output& o) {
    return o.kind != Output::Kind::joint && (bodies.of_link[o.link] == body || bodies.of_link[o.relative_to] == body);
  });
}

}  // namespace

std::vector<Dyad> dyads_of(const Robot& robot, const Bodies& bodies, const Algebra& algebra, const SpanningTree& tree,
                           bool reached) {
  std::vector<Dyad> list;
  std::vector<bool> taken(bodies.joints.size(), false);  // each joint is in one dyad
  const auto end_on = [&](std::size_t joint, std::size_t body) -> const BodyEnd& {
    const auto& ends = bodies.joints[joint].ends;
    return ends[ends[0].body == body ? 0 : 1];
  };
  const auto beyond = [&](std::size_t joint, std::size_t body) {
    const auto& ends = bodies.joints[joint].ends;
    return ends[ends[0].body == body ? 1 : 0].body;
  };
  for (const TreeEdge& edge : tree.edges) {
    const std::size_t link = bodies.joints[edge.joint].ends[1 - edge.from].body;
    std::vector<std::size_t> others;
    for (std::size_t j = 0; j < bodies.joints.size(); ++j)
      if (j != edge.joint && (bodies.joints[j].ends[0].body == link || bodies.joints[j].ends[1].body == link))
        others.push_back(j);
    if (others.size() != 1 || has_output(robot, bodies, link)) continue;
    const std::size_t outer = others[0];
    if (taken[edge.joint] || taken[outer]) continue;
    if (!is_passive_revolute(robot, bodies.joints[edge.joint]) || !is_passive_revolute(robot, bodies.joints[outer]))
      continue;
    const bool closes = std::find(tree.chords.begin(), tree.chords.end(), outer) != tree.chords.end();
    if (!closes && !reached) continue;
    const BodyEnd &a = end_on(edge.joint, link), &b = end_on(outer, link);
    if (algebra.are_parallel(a.axis, b.axis) || !algebra.is_zero(algebra.clean(b.point - a.point))) continue;
    taken[edge.joint] = taken[outer] = true;
    list.push_back({link, edge, outer, bodies.joints[edge.joint].ends[edge.from].body, beyond(outer, link)});
  }
  return list;
}

}  // namespace corank::kinematics
