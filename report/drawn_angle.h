// The angles of very many boxes, for pictures.
#pragma once

#include "corank/core/interval.h"

namespace corank::report {

/// certify::angle_enclosure to the last bit, in less time where the 11 bits that a long double has more than a double settle
/// how to round. That rests on the C library's atan2l being wrong by less than eight units of its last bit: good for a
/// picture, not for a proof.
Interval drawn_angle(const Interval& c, const Interval& s, const Interval& range);

}  // namespace corank::report
