// Which joints carry the bodies and which close loops.
#pragma once

#include <vector>

#include "corank/kinematics/bodies.h"

namespace corank::kinematics {

/// A joint by which a body is reached from its parent.
struct TreeEdge {
  std::size_t joint = 0;  ///< in Bodies::joints
  std::size_t from = 0;   ///< which end is the parent's
};

struct SpanningTree {
  std::vector<TreeEdge> edges;      ///< from the ground outwards, each parent before its children
  std::vector<std::size_t> chords;  ///< joints that close loops
};

/// Joints of the order 1, then 2 … are taken before those of 0: loops in a plane, sliding ones, those whose angle is a
/// coordinate; rods carry a body only where nothing else does, the shortest of constant length first. Among the rest the
/// ways to the ground are as short as possible, or, `deep`, each branch goes on as far as it can before the next one begins:
/// then loops close at the ground. Throws ModelError, naming a link, where a body is not connected with the
/// ground.
SpanningTree spanning_tree(const Robot& robot, const Bodies& bodies, const Algebra& algebra, const std::vector<int>& order,
                           bool deep = false);

}  // namespace corank::kinematics
