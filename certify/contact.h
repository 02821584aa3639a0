// Where boxes touch the ends of the search domain or the inequalities: what may be cut off there, and why a box is
// `boundary`.
#pragma once

#include <functional>
#include <vector>

#include "corank/core/cover.h"
#include "corank/core/system.h"

namespace corank::certify {

struct Contact {
  enum class With { lower_end, upper_end, inequality };
  With with = With::lower_end;
  int index = 0;  ///< of the variable, or of the inequality
  /// Proven: the set has a point on that end. Theorem: for every value of its free variables in it a `regular` box that
  /// spans() them holds a solution, so for one of them that is on the end; likewise a `boundary` box that has no other
  /// contact. There a dependent variable, too, takes the end's value where it is beyond the end for one value of the free
  /// ones and inside for another: it is a continuous function of them (the zeros in the region are a compact graph) on a
  /// connected box. Tried on a few boxes only.
  bool reached = false;
};

/// Calls `visit` for each box that is not `pending`, with its contacts: ends of the domain that the box does not stay
/// strictly inside of, those that the equations imply and those of variables with one value aside, and inequalities G ≥ 0
/// for which G > 0 is not seen on it. Proves: of a complete cover without contact at an end (an inequality), every solution
/// in the domain is strictly inside of it.
void visit_contacts(const System& system, const Cover& cover,
                    const std::function<void(const CoverBox&, const std::vector<Contact>&)>& visit);

}  // namespace corank::certify
