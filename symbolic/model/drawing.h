// What a report draws for a configuration q: points P(q) ∈ R² or R³, given by expressions in constants and coordinates, and
// parts (links, platforms, joints …) that hang on them. [DRAWING] of a model file; doc/model_language.md describes it.
//
// A drawing proves nothing. The only statements that rest on it are requirements, which may ask for the distance of bodies
// that it names, and take units from it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "corank/symbolic/model/expression.h"

namespace corank::symbolic {

struct DrawingPoint {
  std::string name;
  std::vector<Expression>
      coordinates;  ///< two, or three; angles inside sin, cos and tan only; in the model's unit of length
  SourceLocation where;
  /// As many, linear and homogeneous in the rates, where the mechanism has its own; empty: none is given.
  std::vector<Expression> velocity = {};
};

struct DrawingPart {
  enum class Kind {
    link,      ///< a rigid bar through its points, two or more
    platform,  ///< a rigid polygon, three corners or more
    joint,     ///< revolute joints
    slider,    ///< three points P, A, B: a block (prismatic joint) at P on a rail from A to B
    ground,    ///< joints fixed to the ground
    effector,  ///< the points that do the work
    hinge,     ///< two points A, B: a revolute joint at A with the axis AB; in space only
    ball,      ///< spherical joints
    sphere,    ///< a solid about one point
    cylinder   ///< a solid from one point to another
  };
  Kind kind = Kind::link;
  std::vector<std::string> points;
  SourceLocation where;
  Expression radius{};   ///< of a sphere or cylinder: constants, not negative; in the model's unit of length
  std::string colour{};  ///< of a link, platform, sphere or cylinder: "#rrggbb"; empty: the picture's own
  std::string name{};    ///< likewise: of the body that this is, or of which it is a part; empty: nothing asks for it

  bool has_radius() const { return kind == Kind::sphere || kind == Kind::cylinder; }
};

const char* to_string(DrawingPart::Kind kind);             ///< "link", "platform" …
DrawingPart::Kind drawing_part_of(std::string_view word);  ///< for one of these words

struct Drawing {
  std::vector<DrawingPoint> points;
  std::vector<DrawingPart> parts;
  std::string unit;  ///< of lengths, "mm"; empty where the model says none

  bool empty() const { return points.empty() && parts.empty() && unit.empty(); }
  /// 2 or 3, the number of coordinates of every point; 2 where there is none.
  int dimension() const { return points.empty() ? 2 : static_cast<int>(points.front().coordinates.size()); }
  /// Index of a point, −1 where there is none.
  int find(const std::string& point) const;
  /// Throws ModelError, with the place, for: a point named twice, with one or more than three coordinates, or with another
  /// number of them than the first, or a velocity with another number; a part with an unknown point, a point twice, too few
  /// or too many; a hinge in the plane; a colour that is none, or of a part that has none; a name likewise. Radii are the
  /// matter of Mechanism::validate().
  void validate() const;
};

}  // namespace corank::symbolic
