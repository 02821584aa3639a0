// The velocity equation of a spatial robot, by twists: rates of the joints, and of bodies that only rods carry; rows for
// each joint that closes a loop and for each rod.
//
//   Σ_k ω_k a_k = 0 and Σ_k ω_k a_k × (c − c_k) + v_k a_k = 0 over a loop's joints; (p₁ − p₀)·(v₁ − v₀) = l l̇ of a rod.
//
// Davies, "Kirchhoff's circulation law applied to multi-loop kinematic chains", 1981 (key Davies1981). The rows are the
// derivatives of the loop's conditions along a motion, written in independent rates: at every configuration they have the
// same feasible motions as Φ_q, so both forms name the same singular configurations (doc/theory.md).
//
// A dyad (spanning_tree.h) says one thing of what turns on its axes a and b, (ω₁ − ω₀)·(a × b) = 0; its own rates follow. A
// link of a spherical robot whose orientation is asked for turns by the three rates of this output, so that each leg has
// rows of its own: these are the robot's wrenches, u·(a × b) θ̇ = ω·(a × b).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "corank/kinematics/equations/frames.h"

namespace corank::kinematics {

/// One rate's part of a body's motion.
struct Screw {
  ex rate;
  Vec axis;   ///< of turning, or the direction of sliding
  Vec point;  ///< that it turns about; unused where it slides
  bool turns = true;
};

class Twists : Drafter {
 public:
  Twists(const Drafter& drafter, const SpanningTree& tree, Frames& frames, PlaneLoops& loops, const Positions& positions,
         bool spherical)
      : Drafter(drafter),
        tree_(tree),
        frames_(frames),
        loops_(loops),
        positions_(positions),
        spherical_(spherical),
        motion_(bodies_.size()) {}

  /// Declares the rates and adds the rows.
  void run();
  /// Of a body's point that is at c, in the rates.
  Vec velocity(std::size_t body, const Vec& c) const;

 private:
  Vec place(const BodyEnd& end) const { return positions_.place(end); }
  Vec axis(const BodyJoint& j, std::size_t end);
  Vec own_axis(std::size_t joint, std::size_t body) const;
  std::array<Vec, 2> axes(const Dyad& dyad);  ///< in the world
  symbolic::Role role(std::size_t joint) const;
  /// Is the joint's rate one that others know?
  bool has_rate(std::size_t joint) const;
  ex angular(const BodyJoint& j, const std::string& suffix = "");
  ex linear(const BodyJoint& j, const std::string& suffix = "");
  /// The screws of a joint, as motions of end 1's body relative to end 0's.
  std::vector<Screw> screws(const BodyJoint& j);
  /// By whose rates the body turns that a tree's edge reaches: an output's, or nothing.
  const Output* turned_by_output(const TreeEdge& edge) const;
  /// `of`: which of the components.
  Vec output_rates(const std::string& prefix, const Output& output, symbolic::CoordinateKind kind,
                   const std::array<bool, 3>& of);
  void reach(const TreeEdge& edge);
  void turn_within(const Dyad& dyad);
  /// Of a group of a plane's loops, about the normal, from the body that carries them.
  ex turning_in_plane(const PlanePart& part, std::size_t group) const;
  /// Of end 1's body from end 0's, about the joint's axis, by other joints of the plane's loops.
  ex relative_turning(const PlanePart& part, const BodyJoint& j) const;
  void add_velocity(Vec& sum, const std::vector<Screw>& screws, const Vec& c, int sign) const;
  Vec turning(std::size_t body) const;
  void row(const ex& e, const Joint& of);
  void rows(const Vec& v, const Joint& of);
  /// v along the directions in which the loop closes that the joint closes.
  void closing_rows(const Vec& v, const BodyJoint& j);
  void close(const BodyJoint& j);
  void close_in_plane(const BodyJoint& j, const PlanePart& part, const std::vector<ex>& closing);
  void close(const Dyad& dyad);
  void add(const Output& output);

  const SpanningTree& tree_;
  Frames& frames_;
  PlaneLoops& loops_;
  const Positions& positions_;
  bool spherical_;
  std::vector<Dyad> dyads_;
  std::vector<std::vector<Screw>> motion_;  // of each body, relative to the ground
  std::map<std::size_t, ex> rate_of_;       // of joints in bodies_ that have one rate
};

}  // namespace corank::kinematics
