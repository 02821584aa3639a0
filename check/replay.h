// Replays the script of a search (core/proof.h) in the checker's own arithmetic: is every zero in the domain in a box of
// the cover?
#pragma once

#include <functional>

#include "corank/check/checker.h"
#include "corank/check/problem.h"

namespace corank::check {

struct Replayed {
  ProofTally tally;
  std::vector<Failure> failures;
  bool malformed = false, interrupted = false;
};

/// `step` is called now and then with the number of the next step; it returns true where the replay is to end.
Replayed replay(const Problem& problem, const Cover& cover, const std::function<bool(std::uint64_t)>& step);

}  // namespace corank::check
