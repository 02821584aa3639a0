// The rotations of a spatial robot's groups of bodies, as images of directions in the world, and where its bodies are.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "corank/kinematics/equations/draft.h"
#include "corank/kinematics/loops/plane_loops.h"
#include "corank/kinematics/loops/spanning_tree.h"

namespace corank::kinematics {

class Frames : Drafter {
 public:
  /// The ground's frame is the world's; every other group gets its own by orient().
  Frames(const Drafter& drafter, PlaneLoops& loops);

  /// In the world: a constant vector that is fixed in a group which has its frame.
  Vec image(std::size_t group, const Vec& v);
  bool has_frame(std::size_t group) const { return frames_[group].has_value(); }
  /// The frame's own directions in the group (their cross product is the third) and in the world.
  const std::array<Vec, 2>& directions(std::size_t group) const { return frames_[group]->own; }
  Vec direction(std::size_t group, std::size_t i);
  /// Coefficients of v along the two directions and their cross product.
  Vec coefficients(std::size_t group, const Vec& v) const;

  /// Two directions of the group in the world that are perpendicular to v, a unit vector there, and never parallel to each
  /// other: v × b and (v·b) v − b, b another of the group's own directions.
  std::array<Vec, 2> across(std::size_t group, const Vec& v);

  /// From now on a cross product is written out, so that images add no coordinates to what is complete.
  void finish() { finished_ = true; }

  /// Gives a group a frame R Rz Ry Rx by three angles, whose ranges are [0, 0]: so it is found where it is R, and turns.
  void keep(std::size_t group, const Mat& rotation, const std::string& name, const SourceLocation& where);
  /// Gives the far group its frame, by a tree's edge.
  void orient(const TreeEdge& edge);
  /// What a joint that closes a loop asks of the orientations of its bodies.
  void close(const BodyJoint& joint);
  /// The ranges of angles that are no coordinates.
  void limit(const BodyJoint& joint);

  /// Of a joint's angle, which becomes a coordinate, or follows one.
  struct CosineSine {
    ex cosine, sine;
  };
  CosineSine own_angle(std::size_t joint);

  /// The angle of a joint, where it is a coordinate or follows one.
  const std::optional<ex>& angle(std::size_t joint) const { return angles_[joint]; }

 private:
  struct Frame {
    std::array<Vec, 2> own, world;
    std::optional<Vec> third;  ///< world[0] × world[1], once it was needed
    bool is_product = false;   ///< world[1] is one, of which coordinates are made once it is needed
  };

  std::string name_of_group(std::size_t group) const;
  bool is_simple(const Vec& v) const;
  /// v itself where it is simple, else new coordinates that equal it.
  Vec simplified(const Vec& v, const std::string& name, const SourceLocation& where);
  /// The world's image of a joint's axis, which both of its links share, as soon as one has its frame.
  Vec axis(std::size_t joint, std::size_t end);
  void turn_by_angle(const TreeEdge& edge);
  /// By an angle from the body that carries the loops in a plane. False where the edge is in none of these.
  bool turn_in_plane(const TreeEdge& edge);
  void close_in_plane(const BodyJoint& joint, const PlanePart& part);
  void turn_by_universal(const TreeEdge& edge);
  /// A new unit vector along one of the group's own directions.
  void start_free(std::size_t group, const SourceLocation& where);
  /// The second direction of a group that has one: a joint's axis, or any other.
  void complete(std::size_t group, const Vec& own, const Vec& world, const SourceLocation& where);
  struct Candidate {
    Vec own;
    std::optional<std::size_t> joint;  ///< in Bodies::joints
    std::size_t end = 0;
  };
  std::vector<Candidate> candidates(std::size_t group) const;

  PlaneLoops& loops_;
  bool finished_ = false;
  std::vector<std::optional<Frame>> frames_;  // of each group
  std::vector<std::optional<Vec>> axes_;      // of each joint in bodies_, in the world
  std::vector<bool> aligned_;                 // of each joint in bodies_: both links have the same axis
  std::vector<std::optional<ex>> angles_;     // of each joint of the robot
};

/// Where the bodies are, in the world.
struct Positions {
  const Bodies& bodies;
  const Algebra& algebra;
  Frames& frames;
  std::vector<std::optional<Vec>> origins{};     ///< of each body's frame
  std::vector<std::optional<ex>> coordinates{};  ///< of each joint of the robot: its angle, way or length
  std::map<std::string, Vec> output_points{};    ///< by the output's name
  /// Of joints in Bodies::joints that close a loop along other directions than the world's: these three.
  std::map<std::size_t, std::array<Vec, 3>> closing{};

  /// A vector that is fixed in a body.
  Vec image(std::size_t body, const Vec& v) const { return frames.image(bodies.group[body], v); }
  /// A joint's point on a body that has its origin.
  Vec place(const BodyEnd& end) const { return algebra.clean(*origins[end.body] + image(end.body, end.point)); }
};

}  // namespace corank::kinematics
