// A robot as its parts: links, and the joints between them. A plain value that readers fill (part_file.h, urdf.h) or a C++
// program builds; mechanism_of() (assembly.h) makes its equations.
//
// All geometry is given in the frame of a link, by expressions in the robot's constants. The first link is the ground,
// whose frame is the world's. Lengths have the model's unit, angles are in radians.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "corank/symbolic/model/mechanism.h"

namespace corank::kinematics {

using symbolic::Expression;
using symbolic::SourceLocation;

/// Coordinates in a link's frame, or a direction there.
using Vector = std::array<Expression, 3>;

/// x ↦ R x + p, R row by row: the pose of one frame in another.
struct Pose {
  std::array<Vector, 3> rotation{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Vector translation{0, 0, 0};
};

/// What a report draws of a link. Nothing rests on it but requirements of distances.
struct Shape {
  enum class Kind { sphere, cylinder, polygon };  ///< a polygon of two corners is a line
  Kind kind = Kind::sphere;
  std::vector<Vector> points;  ///< a sphere's centre, a cylinder's two ends, a polygon's corners
  Expression radius;           ///< of spheres and cylinders
  std::string colour;          ///< "#rrggbb"; empty: the report chooses
  SourceLocation where;
};

struct Link {
  std::string name;
  std::vector<Shape> shapes;
  SourceLocation where;
};

enum class JointKind {
  revolute,           ///< points coincide, axes coincide; turns about the axis
  prismatic,          ///< axes coincide, orientation kept; slides along the axis
  cylindrical,        ///< axes coincide; turns and slides
  universal,          ///< points coincide, the ends' axes stay perpendicular
  spherical,          ///< points coincide
  slot,               ///< end 1's point, a pin or a ball, is on end 0's axis: slides along it, turns about itself
  planar,             ///< normals coincide and the points stay in one plane: turns about the normal, slides in the plane
  parallelogram,      ///< orientation kept; the second point goes round the first on a circle about the axis
  fixed,              ///< the second link's frame has a constant pose in the first's
  distance,           ///< spherical–spherical: a rod of constant length between the points
  distance_variable,  ///< spherical–prismatic–spherical: a rod of variable length
  universal_rod  ///< universal–prismatic–universal, inner axes parallel: such a rod in one plane with the ends' axes
};

struct JointTraits {
  JointKind kind;
  const char* name;        ///< "revolute" …, "fix", "sph_sph", "sph_prs_sph", "uni_prs_uni"
  int freedom;             ///< in how many ways its links move on each other, in space
  std::size_t ranges = 0;  ///< how many it may be given, each for one of its values
  bool has_axis = false;
  bool has_angle = false;  ///< which counts from a zero direction
};
/// One for each kind.
std::span<const JointTraits> joint_traits();
const JointTraits& traits(JointKind kind);
inline const char* to_string(JointKind kind) { return traits(kind).name; }

/// Has it an angle or a displacement of its own, that may be an input or an output?
inline bool has_coordinate(JointKind kind) { return kind != JointKind::spherical && traits(kind).ranges > 0; }
/// Of all kinds, or of those that have one.
std::vector<std::string> kind_names(bool with_coordinate = false);

/// A rod whose length is a coordinate.
inline bool is_extensible(JointKind kind) {
  return kind == JointKind::distance_variable || kind == JointKind::universal_rod;
}
/// A rod between two points.
inline bool is_rod(JointKind kind) { return kind == JointKind::distance || is_extensible(kind); }
/// Do the frames of a moving joint's two links stay as they are turned to each other?
inline bool keeps_orientation(JointKind kind) { return kind == JointKind::prismatic || kind == JointKind::parallelogram; }
/// Does the joint leave one way to move, which other joints may follow?
inline bool moves_one_way(JointKind kind) { return kind == JointKind::revolute || keeps_orientation(kind); }
/// Do its links turn about a point, which is that of both ends?
inline bool turns_about_point(JointKind kind) {
  return kind == JointKind::revolute || kind == JointKind::universal || kind == JointKind::spherical;
}

/// Of a joint on one of its two links.
struct JointEnd {
  std::size_t link = 0;
  Vector point{0, 0, 0};
  Vector axis{0, 0, 0};  ///< a direction, of any length but 0; without meaning for fixed, spherical, rods, a slot's pin
  std::optional<Vector>
      zero;             ///< a direction that is no multiple of the axis: the angle is measured between the ends' zeros
  std::string label{};  ///< what a picture calls the point; empty: as the joint is called
};

struct Range {
  Expression lower, upper;
};

struct Joint {
  std::string name;
  JointKind kind = JointKind::revolute;
  std::array<JointEnd, 2> ends;
  /// revolute: of the angle by which end 1's zero is turned from end 0's, about the axis; universal: of the angle about
  /// end 0's axis that turns end 0's zero to end 1's axis, then of the angle about end 1's axis that turns end 0's axis to
  /// end 1's zero; prismatic, slot: of the way of end 1's point from end 0's along the axis; cylindrical: of the
  /// angle, then of the way; parallelogram: of the angle of the way from end 0's point to end 1's, from end 0's zero;
  /// spherical: of the angle between the ends' axes (a cone), as [0, half angle]; extensible rods: of the length.
  std::vector<std::optional<Range>> ranges;
  Pose pose;          ///< fixed: end 1's link in end 0's
  Expression length;  ///< distance, and the circle's radius of a parallelogram
  bool actuated = false;
  bool is_named = false;  ///< by the author; else the reader made the name
  SourceLocation where;

  std::optional<Range> range(std::size_t i = 0) const { return i < ranges.size() ? ranges[i] : std::nullopt; }
};

/// One joint follows another, as by a gear: its angle (of a revolute joint or a parallelogram) or its way (of a prismatic
/// joint) is `ratio` times the driver's, plus `offset`.
struct Coupling {
  std::size_t driver = 0, follower = 0;  ///< in Robot::joints
  Expression ratio = 1, offset = 0;
  SourceLocation where;
};

/// What is asked of a robot's motion: coordinates that are outputs.
struct Output {
  enum class Kind {
    position,     ///< of a point of `link`, in the frame of `relative_to`
    orientation,  ///< of `link` there: an angle in the plane, else a rotation matrix
    pose,         ///< both
    direction,    ///< of a direction fixed in `link`: a unit vector
    joint         ///< the angle or the way of a joint
  };
  Kind kind = Kind::position;
  std::string name;  ///< of the coordinates: name_x …; a joint's has the joint's name
  std::size_t link = 0, relative_to = 0, joint = 0;
  Vector point{0, 0, 0};                        ///< or the direction
  std::array<bool, 3> asked{true, true, true};  ///< of a position: which components are outputs
  /// A slice of the robot's motion is looked at: configurations of these components of a position, and of this orientation
  /// (a rotation). The robot moves as it would without; only where it is found is restricted.
  std::array<std::optional<Range>, 3> ranges{};
  std::optional<Pose> kept{};
  std::optional<Range> turn{};  ///< of an orientation or a pose in the plane: of its angle
  SourceLocation where;
};

struct Robot {
  std::string name = "robot", file;
  std::string unit;  ///< of lengths, "mm"; may be empty
  std::vector<symbolic::Constant> constants;
  std::vector<Link> links;
  std::vector<Joint> joints;
  std::vector<Coupling> couplings;
  /// Opposite sides of parallelograms that are written out stay parallel (parallelograms.h), said here. Such a loop does
  /// not close crosswise then, and has no branches that cross where it is flat.
  std::optional<SourceLocation> keeps_parallelograms;
  std::vector<Output> outputs;
  /// Further conditions among the coordinates of mechanism_of(), by their names there.
  std::vector<symbolic::Constraint> equations;
  /// In the names of mechanism_of(): its coordinates and rates, and the bodies and points of its drawing.
  std::vector<symbolic::RequirementLine> requirements;
  /// What a reader passed over, one sentence each: "dynamics (mass, inertia), 6 times".
  std::vector<std::string> notices;
  /// What is part of the robot but could not be read, one for each with file and line: "a.world:7: the equations of
  /// 'b.cuik': there is no such file". mechanism_of() refuses such a robot; it can be looked at.
  std::vector<std::string> missing;

  /// Index of a link, of a joint; −1 where there is none.
  int find_link(const std::string& link) const;
  int find_joint(const std::string& joint) const;
  /// Does the joint follow another one, or lead one? Is it an output? Is it either, or actuated?
  bool is_coupled(std::size_t joint) const;
  bool is_output(std::size_t joint) const;
  bool is_asked_for(std::size_t joint) const { return joints[joint].actuated || is_coupled(joint) || is_output(joint); }

  // For robots built in C++. Links and joints are known by their names; each returns the index.
  std::size_t link(const std::string& name);
  Joint& revolute(const std::string& name, const std::string& first, const Vector& point, const Vector& axis,
                  const std::string& second, const Vector& second_point, const Vector& second_axis);
  Joint& join(JointKind kind, const std::string& name, const std::string& first, const Vector& point, const Vector& axis,
              const std::string& second, const Vector& second_point, const Vector& second_axis);
  Joint& rod(const std::string& name, const std::string& first, const Vector& point, const std::string& second,
             const Vector& second_point, const std::optional<Expression>& length);
  Joint& fix(const std::string& first, const std::string& second, const Pose& pose);
  /// Holds a revolute or prismatic joint where its coordinate has this value. False, and nothing is changed, for others, for
  /// joints that are coupled or outputs, and where both ends lack a zero and the axis is not along a frame's.
  bool lock(std::size_t joint, const Expression& value);

  /// Throws ModelError, with the place, for: no links; names that are taken; a joint of a link with itself or with a link
  /// that is not there; an axis or a zero direction that is 0, a zero along the axis; a range that is empty, or too many of
  /// them; a pose that is no rotation; a rod's length that is not positive; an actuated joint without a motion of one
  /// coordinate; joints that follow one another in a circle, or such of different kinds, or two of a train that are
  /// actuated; an output of what is not there, or of an actuated joint; a link that no joint connects with the ground; and
  /// for an expression that is no number in the robot's constants.
  void validate() const;
};

}  // namespace corank::kinematics
