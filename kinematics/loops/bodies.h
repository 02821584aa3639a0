// The rigid bodies of a robot: links that fixed joints make one, with the joints between them in the bodies' frames. Bodies
// that only slide or circle on each other keep their relative orientation: together they are a *group*, with one rotation.
#pragma once

#include <algorithm>
#include <array>
#include <deque>
#include <optional>
#include <vector>

#include "corank/kinematics/robot/algebra.h"
#include "corank/symbolic/sets/parameters.h"

namespace corank::kinematics {

/// A link's frame in its body's: x ↦ R x + p.
struct Placement {
  Mat rotation = identity();
  Vec translation{0, 0, 0};
};

/// Of a joint on a body, in the body's frame. The frames of the bodies of a group stay parallel.
struct BodyEnd {
  std::size_t body = 0;
  Vec point;
  Vec axis;  ///< of length 1; 0 for joints without
  Vec zero;  ///< of length 1, perpendicular to the axis; 0 for joints without axis
};

struct BodyJoint {
  std::size_t index = 0;  ///< in Robot::joints
  JointKind kind = JointKind::revolute;
  std::array<BodyEnd, 2> ends;
};

/// The direction of the far body that `known` is of the near one, where they turn on each other about it; nothing where they
/// turn about another.
std::optional<Vec> carried_over(const Vec& known, const BodyEnd& near, const BodyEnd& far, const Algebra& algebra);

/// e1, e2 and n, for a unit vector n: a plane's two directions and its normal, as rows.
Mat basis_of(const Vec& n, const Algebra& algebra);

struct Bodies {
  std::vector<std::size_t> of_link;  ///< body of each link; 0 is the ground
  std::vector<Placement> placement;  ///< of each link's frame in its body's
  std::vector<std::size_t> group;    ///< of each body; 0 is the ground's
  std::size_t groups = 0;
  std::vector<BodyJoint> joints;  ///< all but the fixed ones and idle rods
  /// Rods that ask for nothing: the joints alone keep their ends apart by their length, as where one of them is on the axis
  /// about which the other turns. They are drawn.
  std::vector<BodyJoint> idle_rods;

  std::size_t size() const { return group.size(); }
  /// The first link of a body.
  std::size_t link_of(std::size_t body) const { return std::ranges::find(of_link, body) - of_link.begin(); }
  /// Is a body's place or orientation asked for, or another one's relative to it?
  bool has_output(const Robot& robot, std::size_t body) const;
  bool has_shapes(const Robot& robot, std::size_t body) const;
};

/// From body to body: step(j, near, far) for each of these joints (in Bodies::joints) on each body that is reached, near
/// being its end there. Where it says so, far's body is reached.
template <typename Step>
void walk(const Bodies& bodies, const std::vector<std::size_t>& joints, std::size_t start, Step&& step) {
  std::deque<std::size_t> waiting{start};
  for (; !waiting.empty(); waiting.pop_front())
    for (const std::size_t j : joints)
      for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
        const BodyEnd &near = bodies.joints[j].ends[side], &far = bodies.joints[j].ends[1 - side];
        if (near.body == waiting.front() && step(j, near, far)) waiting.push_back(far.body);
      }
}

/// Throws ModelError where fixed joints contradict one another, sliding joints or parallelograms that are kept ask one link
/// for two orientations, or joints keep a rod's ends at another distance than its length; where the robot keeps
/// parallelograms and has no such loop.
Bodies bodies_of(const Robot& robot, Algebra& algebra);

/// The same robot: in loops of turning joints (revolute, universal, spherical) whose axes all go through one point, each
/// joint's points are moved along its axis to that point, wherever on the axis they are given. Such loops close wherever
/// their bodies are turned to, and then they do so term by term. Loops that share a joint are looked at together.
///
/// A revolute joint asks that a line of one body, with a point on it, lies on that of the other: moving both points along by
/// the same way asks for the same.
Bodies about_centres(const Robot& robot, const Bodies& bodies, Algebra& algebra);

/// What decided so far how the equations are made: what the algebra did, and what the reader of the parts did of axes. Short
/// ones come first.
std::vector<symbolic::Condition> conditions_of(const Robot& robot, const Bodies& bodies, const Algebra& algebra);

}  // namespace corank::kinematics
