// Finds, before a search, the sets of degenerate solutions that the search would meet everywhere, and proves boxes on them.
//
// Example: of the inverse singularities of the Agile Eye four sets have dimension 3 where 2 is expected. In each of them the
// eye stands still and all three motors turn freely. Random starts lead to such sets, since they are large: no box has to
// become narrow first.
#pragma once

#include <functional>
#include <vector>

#include "corank/certify/newton.h"
#include "corank/solve/step/options.h"
#include "corank/solve/step/problem.h"

namespace corank::solve {

/// The problem of a search, its strata included. These depend on the prepared system alone, so all who search it know the
/// same ones, in the same order. None are sought for sets of points, in given boxes, and with parameters or tolerances.
Problem problem_with_strata(const Prepared& prepared, std::function<bool()> ended);

/// A sheet on the motion with this index, and the step of its proof; not proven where certify::prove_self_motion proves
/// nothing in x.
struct MotionProof {
  certify::Sheet sheet;
  certify::Preconditioner step;
};
MotionProof prove_on_stratum(const Problem& problem, const certify::SelfMotion& motion, int index, const Box& x,
                             certify::NewtonWorkspace& workspace);

}  // namespace corank::solve
