// Digits of isolated points, each of them proven.
#pragma once

#include "corank/core/cover.h"
#include "corank/solve/control.h"
#include "corank/solve/prepared.h"

namespace corank::solve {

/// Fills cover.decimals: for every isolated or exact point of a set of dimension 0 decimals with so many digits after the
/// point, proven by certify::prove_zero, or from its exact coordinates. Points that are left once the control has ended the
/// run have none.
void prove_decimals(const Prepared& prepared, int digits, Cover& cover, Control& control);

}  // namespace corank::solve
