// Nodes are sought in two steps: first the locus, then pairs of its boxes whose locked coordinates may be the same. The
// search over the whole domain would meet every pair of places before it knows that neither is on the locus.
#pragma once

#include "corank/solve/control.h"
#include "corank/solve/solve.h"
#include "corank/study/question.h"

namespace corank::study {

/// What a search for nodes starts from: certify::pairs of the locus's cover.
struct NodeSearch {
  std::vector<Box> roots;       ///< none: the whole domain is to be searched, since the pairs are too many
  std::uint64_t processed = 0;  ///< boxes, for the locus
};

/// `system`: study::system(question), of forward_nodes or inverse_nodes.
NodeSearch node_search(const Question& question, const System& system, const solve::Options& options,
                       solve::Control& control);

}  // namespace corank::study
