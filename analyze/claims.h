// What a clearance claims, but for a millionth of the radius, as results that corank verify checks like any other: with code
// that shares nothing with the search.
#pragma once

#include <optional>

#include "corank/analyze/clearance.h"
#include "corank/result/result.h"

namespace corank::analyze {

/// "No singularity is nearer than the lower bound": the set of the ball's model within that radius, whose cover is empty and
/// has its proof of completeness. Where a limit or degenerate solutions end the search before that, boxes are left.
result::Result claim_free(const Clearance& clearance, const solve::Options& search, solve::Control& control);

/// "There is a singularity no farther than the upper bound": the set within that radius, of whose cover this is one box. It
/// holds a solution for the values of its free variables, which are points. Nothing where there is none, or none can be
/// proven so near the edge.
std::optional<result::Result> claim_nearest(const Clearance& clearance, solve::Control& control);

}  // namespace corank::analyze
