// An angle whose cosine and sine are known exactly, in a short text.
#pragma once

#include <optional>
#include <string>

#include "corank/certify/angle.h"
#include "corank/core/exact_point.h"
#include "corank/core/system.h"

namespace corank::result {

/// "-3/5", "1/2*sqrt(3)": a coordinate of an exact point, where it has a short text; nothing, too, where what a file says of
/// the point defines no number.
std::optional<std::string> exact_coordinate(const ExactPoint& point, int variable);

/// "3*pi/4", where that is the angle, exactly, with `enclosure` to tell its turn. Nothing for other angles.
std::optional<std::string> multiple_of_pi(const ExactPoint& point, const Angle& angle, const Interval& enclosure);

/// That, or "atan2(4/5, 3/5)" with sine and cosine; nothing where these have no short text.
std::optional<std::string> exact_angle(const ExactPoint& point, const Angle& angle, const Interval& enclosure);

}  // namespace corank::result
