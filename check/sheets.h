// Boxes that a sheet proves: regular, isolated, boundary.
#pragma once

#include <string>

#include "corank/check/krawczyk.h"
#include "corank/check/problem.h"

namespace corank::check {

/// Checks what the verdict of the box says, with `region` the box of its proof:
///   for every value of the free variables in the box there is exactly one solution of the equations in the region (theorem
///   of doc/theory.md, on parts of the box's free sides where need be), and it lies in the box, which lies in the region;
///   regular, isolated: it lies in the exact domain and satisfies the inequalities.
/// Returns what could not be shown, nothing where all was.
/// The equations are those given: the problem's, or others that imply them (check/self_motion.h).
std::string check_sheet(const Problem& problem, const std::vector<Row>& equations, const CoverBox& box, const Box& region);

}  // namespace corank::check
