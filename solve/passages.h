// Which configurations of a workspace boundary the output can pass.
#pragma once

#include "corank/core/cover.h"
#include "corank/solve/control.h"
#include "corank/solve/prepared.h"

namespace corank::solve {

/// CoverBox::passage and side of every box, where the system is a part of a workspace boundary (certify::PassageTest, on
/// parts of the box where it must). What is left once the control has ended stays unproven.
void prove_passages(const Prepared& prepared, Cover& cover, Control& control);

}  // namespace corank::solve
