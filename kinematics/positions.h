// Where the bodies of a robot in space are.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "corank/kinematics/frames.h"

namespace corank::kinematics {

/// In the world.
struct Positions {
  const Bodies& bodies;
  const Algebra& algebra;
  Frames& frames;
  std::vector<std::optional<Vec>> origins{};    ///< of each body's frame
  std::vector<std::optional<ex>> coordinate{};  ///< of each joint of the robot: its angle, way or length
  std::map<std::string, Vec> output_points{};   ///< by the output's name
  /// Of joints in Bodies::joints that close a loop along other directions than the world's: these three.
  std::map<std::size_t, std::array<Vec, 3>> closing{};

  /// A vector that is fixed in a body.
  Vec image(std::size_t body, const Vec& v) const { return frames.image(bodies.group[body], v); }
  /// A joint's point on a body that has its origin.
  Vec place(const BodyEnd& end) const { return algebra.clean(*origins[end.body] + image(end.body, end.point)); }
};

}  // namespace corank::kinematics
