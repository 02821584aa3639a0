// A set that is solved in parts: samples of the set are looked for in the parts, and samples of the parts in the set.
//
// The parts are made by exact algebra (symbolic/sets/set_parts.h), and a check makes them again by the same. This is a
// second opinion, by numbers alone, which knows nothing of factors, blocks or products. It refuses no parts that are right:
// each sample is proven to be a solution (solution_near), and what is said against the parts is proven, too: that no part,
// or not the set, has a solution with the sample's coordinates. It proves nothing for them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "corank/check/stop.h"
#include "corank/core/system.h"

namespace corank::check {

struct PartOfSet {
  std::string name;
  System system;
  /// Coordinates, lengths and angles, of which it says that every value belongs to a solution; its system may not have them.
  std::vector<std::string> free{};
};

struct PartSamples {
  std::size_t of_set = 0, of_parts = 0;  ///< how many were drawn
  std::vector<std::string> failures;     ///< of the first sample that is refused
};

/// `set`: M(q) ξ = 0 with a square M, or another system whose solutions have the parts' coordinates. Throws Stopped.
PartSamples sample_parts(const System& set, const std::vector<PartOfSet>& parts, std::uint64_t seed,
                         const StopFlag& stop = {});

}  // namespace corank::check
