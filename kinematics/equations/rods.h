// The equations of rods between balls, and of bodies that only rods carry.
//
// A body hangs on a rod by the vector p along it, |p|² = l², three coordinates. Of another rod between the same bodies, or
// bodies at rest with them, the equation is linear in p, in p's components along the body's own directions, and the frame.
//
// Two rods of fixed lengths l₊ and l₋ between the same two bodies that move, and no third, are taken together. With half the
// sum p of their vectors, and half the difference δ, which the two bodies' orientations give,
//
//   |p ± δ|² = l±²   ⟺   p·δ = (l₊² − l₋²)/4,   |p|² + |δ|² = (l₊² + l₋²)/2.
//
// So what two rods ask of the orientation stands apart: p·δ = 0 where they are equally long. Of rods from bodies at rest the
// linear equations above are better.
#pragma once

#include <optional>
#include <vector>

#include "corank/kinematics/equations/frames.h"

namespace corank::kinematics {

class Rods : Drafter {
 public:
  Rods(const Drafter& drafter, const PlaneLoops& loops, Positions& positions);

  /// A rod's length; declares the coordinate of one that varies.
  ex length(const BodyJoint& rod);
  /// From the rod's point on the body that carries it to that on the body that hangs on it.
  Vec hang(const TreeEdge& edge);
  /// Of a rod that closes a loop.
  void close(std::size_t joint);
  /// Are two of them taken together?
  bool has_two() const;

 private:
  /// One rod, or two that are taken together, which are then one between the middles of their ends.
  struct Leg {
    std::size_t first = 0;  ///< in bodies_.joints
    std::optional<std::size_t> second{};
    std::array<BodyEnd, 2> ends{};
    ex length{};  ///< the first's
    Vec delta{};  ///< of two: half the first's vector less half the second's, from end 0 to end 1
    ex delta_squared{};
  };
  /// What a body hangs on.
  struct Hung {
    Leg leg;
    std::size_t far;                          ///< the end on the body that hangs
    Vec p;                                    ///< from end 1 − far to end far
    ex square;                                ///< |p|²
    std::array<std::optional<ex>, 3> seen{};  ///< p along the body's directions, once they were needed
  };

  /// Has the joint, which moves one way, a range of one value?
  bool is_held(const Joint& of) const;
  Leg leg_of(std::size_t joint);
  /// Of a component of a leg's vector.
  std::optional<Range> range(const Leg& leg) const;
  /// Coordinates for the leg's vector.
  Vec vector(const Leg& leg, bool auxiliary);
  ex squared_distance(Hung& hung, const Vec& b, const Vec& a);
  /// The leg's equations, p from end 0 to end 1. Returns |p|².
  ex keep_length(const Leg& leg, const Vec& p);
  void keep_in_plane(const Leg& leg, const Vec& p);
  bool depends_on(const Vec& a, const Hung& hung) const;

  Positions& positions_;
  std::vector<std::optional<std::size_t>> other_;  // of each joint in bodies_: the rod that it is taken together with
  std::vector<bool> said_;                         // of each joint in bodies_: with the other's equations
  std::vector<Hung> hung_;
};

}  // namespace corank::kinematics
