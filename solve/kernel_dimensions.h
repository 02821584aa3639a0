// Bounds of the kernel's dimension in the boxes of a cover.
#pragma once

#include "corank/core/cover.h"
#include "corank/solve/control.h"
#include "corank/solve/prepared.h"

namespace corank::solve {

/// CoverBox::kernel_at_most of every box and point, where the system has kernel equations (certify::KernelBound, on parts of
/// the box where it must); a box where it is larger than the system asks for, and that holds a known exact point with such a
/// kernel, names that point. What is left once the control has ended stays as it was.
void bound_kernel_dimensions(const Prepared& prepared, Cover& cover, Control& control);

}  // namespace corank::solve
