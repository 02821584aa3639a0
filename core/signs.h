// The sign of an interval.
#pragma once

#include "corank/core/interval.h"

namespace corank {

/// 1 or −1, the sign of all its numbers; 0: they have not one, or 0 is among them.
inline int sign_of(const Interval& x) { return x.lo() > 0 ? 1 : x.hi() < 0 ? -1 : 0; }

}  // namespace corank
