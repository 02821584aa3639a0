// The coordinates of exactly known points in words.
#pragma once

#include <optional>
#include <string>

#include "corank/certify/exact_point.h"

namespace corank::report {

/// "-3/5", "1/2*sqrt(3)": nothing where the coordinate is not known or has no short text, or where what a file says of the
/// point defines no number.
std::optional<std::string> exact_text(const certify::ExactPoint& point, int variable);

}  // namespace corank::report
