// What a result about cusps or nodes says of the robot, in one sentence that claims no more than its verdicts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corank/result/result.h"

namespace corank::result {

/// "around these 4 cusps assembly modes can be changed without a forward singularity: proven"; of nodes how many
/// there are, and that pairs of configurations closer than symbolic::kNodeDistance were not looked for. Empty for
/// another set.
/// Rests on: an isolated solution of the cusps' system, where its Jacobian has full rank, lies over a cusp of
/// Whitney's, and one of the nodes' system over a transversal crossing (doc/theory.md, "Cusps and nodes"); where a
/// coordinate is held that is not locked, that theorem does not apply, and the sentence says so.
std::string locus_sentence(const Result& result);

/// Of a set of cusps those points that are proven to lie over one of Whitney's, by the theorem that the sentence rests on.
/// None where a coordinate is held to which it does not apply.
std::vector<const CoverBox*> proven_cusps(const Result& result);

/// symbolic::kNodeDistance of a set of nodes.
std::optional<double> node_distance(const Result& result);

}  // namespace corank::result
