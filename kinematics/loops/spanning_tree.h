// Which joints carry the bodies and which close loops, and which links are dyads.
#pragma once

#include <vector>

#include "corank/kinematics/loops/bodies.h"

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
/// then loops close at the ground. All bodies are connected with the ground (Robot::validate).
SpanningTree spanning_tree(const Robot& robot, const Bodies& bodies, const Algebra& algebra, const std::vector<int>& order,
                           bool deep = false);

/// A link with two passive revolute joints and nothing else, whose axes meet in one point at an angle. What it carries
/// turns as on a universal joint whose axes make that angle, so its own rates need not be unknowns.
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
