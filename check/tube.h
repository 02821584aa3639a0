// Is a tube (core/tube.h) what it claims to be? Anew, in MPFI at 160 bits.
//
// Of each node: its box holds a solution of F(x) = 0, T_k·x = c_k (Krawczyk, Brouwer). Of each piece, for every t in [0, 1]:
// its box holds exactly one solution of F(x) = 0, (1 − t)(T_k·x − c_k) + t (T_{k+1}·x − c_{k+1}) = 0, and it holds the boxes
// of its two nodes. So the nodes are the pieces' ends, and the pieces one path. About each piece, so far as its radius says:
// no matrix loses rank, the domain and the inequalities hold, and bodies keep their distances. All of that for every value
// of the parameters.
#pragma once

#include <vector>

#include "corank/check/checker.h"
#include "corank/core/requirement.h"
#include "corank/core/tube.h"

namespace corank::check {

struct TubeReport : Findings {
  std::size_t nodes = 0, pieces = 0;  ///< that are confirmed
  bool verified() const { return failures.empty() && !interrupted; }
  bool complete() const { return verified(); }  ///< its claims leave nothing out
};

/// A matrix is to have the rank of its columns, or of its rows that are not 0 everywhere, whichever are fewer. Never throws
/// for what a tube says.
TubeReport check_tube(const System& system, const std::vector<PolynomialMatrix>& matrices, const Tube& tube,
                      const Options& options = {}, const KeptDistances& distances = {});

}  // namespace corank::check
