// Labels of a cover's boxes, points and exact points: which types of singularity their solutions have.
#pragma once

#include "corank/core/cover.h"
#include "corank/core/singularity_types.h"
#include "corank/solve/control.h"
#include "corank/solve/prepared.h"

namespace corank::solve {

/// CoverBox::types of every box and point, ExactPoint::types, Cover::types (certify::TypeBounds, on parts of the box where
/// it must). What is left once the control has ended stays without, and so does all of a system with a tolerance.
void label_types(const Prepared& prepared, const VelocityBlocks& blocks, Cover& cover, Control& control);

/// Takes out the boxes and points in which no solution has the type, and counts them (Cover::types). Every solution of that
/// type is in a box that stays. Where any goes, the proof of completeness goes as well: it speaks of all boxes.
void keep_only(SingularityType type, Cover& cover);

}  // namespace corank::solve
