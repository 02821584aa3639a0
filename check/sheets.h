// Boxes that a sheet proves: regular, isolated, boundary. And single solutions, found and proven anew near a point.
#pragma once

#include <string>
#include <vector>

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

/// The same of the problem's equations where the region may be narrower than the box along a free variable. Then:
///   for every value of the free variables in the region there is exactly one solution in it, and it lies in the box;
///   for every value of theirs in the box there is at most one solution in the box;
///   regular: each solution in the box lies in the exact domain and satisfies the inequalities.
std::string check_sheet_or_part(const Problem& problem, const CoverBox& box, const Box& region);

/// Encloses a solution of all equations of a problem without a reduction, at which the variables `held` have the point's
/// values exactly, or for every value in `over` of theirs a solution; as many are to be held as the equations leave free.
/// `fault`: why none was shown; empty where one was.
/// Theorem (Krawczyk, Brouwer): where the image of a box lies strictly inside of it, the box holds a solution with the
/// held variables' values; it lies in every further image, too.
Sides solution_near(const Problem& problem, const std::vector<double>& point, const std::vector<int>& held,
                    std::string& fault, const std::vector<Interval>& over = {});

}  // namespace corank::check
