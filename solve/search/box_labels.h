// What is said of a cover's boxes and points beside their verdicts: which types of singularity their solutions have, how
// large the kernel is, whether an output can pass.
#pragma once

#include <optional>

#include "corank/core/cover.h"
#include "corank/core/singularity_types.h"
#include "corank/solve/step/control.h"
#include "corank/solve/step/options.h"

namespace corank::solve {

/// What types of singularity are read off.
struct Labelling {
  VelocityBlocks blocks;
  std::optional<SingularityType> only{};  ///< of a set of one type
};

/// CoverBox::types of every box and point, ExactPoint::types, Cover::types (certify::TypeBounds, on parts of the box where
/// it must). What is left once the control has ended stays without, and so does all of a system with a tolerance.
/// `only`: takes out the boxes and points in which no solution has that type, and counts them (Cover::types). Every solution
/// of that type is in a box that stays. Where any goes, the proof of completeness goes as well: it speaks of all boxes.
void label_types(const Prepared& prepared, const Labelling& labelling, Cover& cover, Control& control);

/// CoverBox::kernel_at_most of every box and point, where the system has kernel equations (certify::KernelBound, on parts of
/// the box where it must); a box where it is larger than the system asks for, and that holds a known exact point with such a
/// kernel, names that point. What is left once the control has ended stays as it was.
void bound_kernel_dimensions(const Prepared& prepared, Cover& cover, Control& control);

/// CoverBox::passage and side of every box, where the system is a part of a workspace boundary (certify::PassageTest, on
/// parts of the box where it must). What is left once the control has ended stays unproven.
void prove_passages(const Prepared& prepared, Cover& cover, Control& control);

}  // namespace corank::solve
