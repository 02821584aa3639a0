// Points and bodies of a drawing that a requirement names, as expressions: a body is a union of rounded convex hulls.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "corank/symbolic/model/drawing.h"
#include "corank/symbolic/model/expression.h"
#include "corank/symbolic/sets/requirement_fault.h"

namespace corank::symbolic {

/// All points within `radius` of the convex hull of the points.
struct RoundedHull {
  std::vector<std::array<Expression, 3>> points;
  Expression radius = 0;
};

/// In the plane its third coordinate is 0. Throws RequirementFault for a name that is none of the drawing's.
std::array<Expression, 3> drawn_point(const Drawing& drawing, const std::string& name);

/// One name of a body: of its parts each sphere, each cylinder, rounded at its ends, each link as the hull of its points,
/// and all platforms, its faces, as one hull. Else names of points, whose hull is the body. Throws RequirementFault as
/// drawn_point() does, and for too many points.
std::vector<RoundedHull> drawn_body(const Drawing& drawing, const std::vector<std::string>& names);

/// As many as the largest body of one hull may have points.
inline constexpr std::size_t kMostPointsOfBody = 64;

}  // namespace corank::symbolic
