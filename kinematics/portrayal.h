// What a report draws of a robot: its links between their joints, its shapes; points move as the rates say.
#pragma once

#include <functional>
#include <optional>

#include "corank/kinematics/draft.h"

namespace corank::kinematics {

/// A point in the picture's coordinates, and its velocity in the rates where the mechanism has such.
struct Motion {
  Vec at;
  std::optional<Vec> velocity;
};

/// Draws in the plane or in space; `place` is where a body's point is.
void draw(const Drafter& drafter, Space space, const std::function<Motion(std::size_t body, const Vec& point)>& place);

}  // namespace corank::kinematics
