// How the search divides its work between Newton steps on a box and bisections, by the kind of set. Heuristic.
#pragma once

#include "corank/core/system.h"

namespace corank::solve {

struct Tuning {
  double gain;          ///< repeat Newton while some variable loses this share of its width
  int repeats;          ///< at most
  double proof_spread;  ///< try a proof below this spread |I − Y·S|
  double sheet_spread;  ///< below it what is in the box may soon be a sheet: divide along its free variables alone
  double free_share;    ///< cut a free side unless it is already so much narrower than the others
  double wide;          ///< of the typical sizes: what a Newton step says of narrower boxes misleads a bisection
};

/// For a (reduced) system. `tolerant`: its equations may be redundant, and its solutions of larger dimension.
Tuning tuning_for(const System& system, bool tolerant);

}  // namespace corank::solve
