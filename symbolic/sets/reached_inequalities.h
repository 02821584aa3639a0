// Which inequalities of a mechanism end its workspace, as limits do.
#pragma once

#include <string>
#include <vector>

#include "corank/symbolic/sets/boundary.h"
#include "corank/symbolic/velocity/velocity_equation.h"

namespace corank::symbolic {

struct ReachedInequality {
  BoundaryPart::Active end;
  bool of_outputs = false;  ///< about outputs alone
};

/// Those that a motion can reach, each once, named by their notes or by their numbers among the model's inequalities. Not
/// one whose derivative by coordinates of more than one value is 0, nor one that is_no_end(). `velocity`: has the columns
/// that move.
std::vector<ReachedInequality> reached_inequalities(const Mechanism& mechanism, const ExpressionMatrix& velocity);

/// Is an inequality among these about the others' coordinates, and those of one value, alone? Then no motion reaches it
/// while they are kept: what is asked of such configurations is asked without it.
bool is_settled(const Mechanism& mechanism, const std::vector<BoundaryPart::Active>& active);

/// Do these limits break an inequality, whatever the other coordinates are?
bool is_impossible(const Mechanism& mechanism, const std::vector<BoundaryPart::Active>& active);

}  // namespace corank::symbolic
