// Dyads: a link with two passive revolute joints and nothing else, whose axes meet in one point at an angle. What it carries
// turns as on a universal joint whose axes make that angle, so its own rates need not be unknowns.
#pragma once

#include <vector>

#include "corank/kinematics/spanning_tree.h"

namespace corank::kinematics {

struct Dyad {
  std::size_t link = 0;          ///< a body
  TreeEdge inner;                ///< by which the tree reaches it
  std::size_t outer = 0;         ///< its other joint, in Bodies::joints
  std::size_t from = 0, to = 0;  ///< the bodies that it joins: the tree's, and the other joint's
};

/// Those whose outer joint closes a loop; with `reached`, those by which the tree goes on to another body, too.
std::vector<Dyad> dyads_of(const Robot& robot, const Bodies& bodies, const Algebra& algebra, const SpanningTree& tree,
                           bool reached);

}  // namespace corank::kinematics
