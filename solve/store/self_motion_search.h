// Finds the linear relations that hold on a set of degenerate solutions, by samples of it. Heuristic: certify/self_motion.h
// proves or refuses what is found.
#pragma once

#include <optional>

#include "corank/certify/self_motion.h"
#include "corank/solve/step/local_solution.h"

namespace corank::solve {

struct MotionCandidate {
  std::optional<certify::SelfMotion> motion;  ///< nothing: no linear relations that suffice
  int dimension = 0;                          ///< of the set, as its samples show; 0: too few were found
};

/// Walks along the set from a degenerate solution and reads the relations off.
MotionCandidate find_self_motion(const Problem& problem, const System& system, const LocalSolution& start);

/// Do the relations hold at x, as far as doubles tell?
bool holds_at(const certify::SelfMotion& motion, const Problem& problem, const std::vector<double>& x);

}  // namespace corank::solve
