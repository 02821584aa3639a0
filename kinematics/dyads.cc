#include "corank/kinematics/dyads.h"

#include <algorithm>

namespace corank::kinematics {
namespace {

/// Neither driven nor asked for.
bool is_passive_revolute(const Robot& robot, const BodyJoint& j) {
  return j.kind == JointKind::revolute && !robot.is_asked_for(j.index);
}

}  // namespace

std::vector<Dyad> dyads_of(const Robot& robot, const Bodies& bodies, const Algebra& algebra, const SpanningTree& tree,
                           bool reached) {
  std::vector<Dyad> list;
  std::vector<bool> taken(bodies.joints.size(), false);  // each joint is in one dyad
  for (const TreeEdge& edge : tree.edges) {
    const std::size_t link = bodies.joints[edge.joint].ends[1 - edge.from].body;
    std::vector<std::size_t> others;
    for (std::size_t j = 0; j < bodies.joints.size(); ++j)
      if (j != edge.joint && (bodies.joints[j].ends[0].body == link || bodies.joints[j].ends[1].body == link))
        others.push_back(j);
    if (others.size() != 1 || bodies.has_output(robot, link)) continue;
    const std::size_t outer = others[0];
    if (taken[edge.joint] || taken[outer]) continue;
    if (!is_passive_revolute(robot, bodies.joints[edge.joint]) || !is_passive_revolute(robot, bodies.joints[outer]))
      continue;
    const bool closes = std::find(tree.chords.begin(), tree.chords.end(), outer) != tree.chords.end();
    if (!closes && !reached) continue;
    const BodyJoint &inner = bodies.joints[edge.joint], &next = bodies.joints[outer];
    const std::size_t near = next.ends[0].body == link ? 0 : 1;
    const BodyEnd &a = inner.ends[1 - edge.from], &b = next.ends[near];
    if (algebra.are_parallel(a.axis, b.axis) || !algebra.is_zero(algebra.clean(b.point - a.point))) continue;
    taken[edge.joint] = taken[outer] = true;
    list.push_back({link, edge, outer, inner.ends[edge.from].body, next.ends[1 - near].body});
  }
  return list;
}

}  // namespace corank::kinematics
