// From what each thread has found to the boxes of a cover, in an order that does not depend on the threads.
//
// The boxes stay where their thread has put them until they are copied into the cover: pointers are sorted. Every function
// is to be called in the arena whose threads it may use.
#pragma once

#include <vector>

#include "corank/certify/reduction.h"
#include "corank/core/ended.h"
#include "corank/solve/problem.h"

namespace corank::solve {

/// By their sides in the variables that were kept, then by what is claimed of them (solve/box_order.h).
void sort(std::vector<Found*>& found);

/// Replaces pairs of touching regular boxes over the same free variables by one, again and again, where their hull can be
/// proven as any box is (certify::newton_prove) and is no wider than σ. The proof's image holds every zero of the hull, so
/// nothing is lost. The result depends on the boxes and their order only; once `ended` is true the other boxes stay as they
/// are.
void merge_regular(const Problem& problem, std::vector<Found*>& found, const Ended& ended = {});

/// Numbers the regions of the boxes' proofs by the first box that has each, and returns them in all variables.
std::vector<Box> number_regions(const certify::Reduction& reduction, const std::vector<Found*>& found);

/// The box in all variables of the system that was reduced.
CoverBox lifted(const System& system, const certify::Reduction& reduction, CoverBox box);

/// The same of those boxes of the lists that `found` names, in its order. The lists are emptied as their boxes are taken, so
/// that no box is held twice.
std::vector<CoverBox> take_lifted(const System& system, const certify::Reduction& reduction, std::vector<Found*> found,
                                  const std::vector<FoundList*>& lists);

}  // namespace corank::solve
